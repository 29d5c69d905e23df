// Adds to the forces of a vertex that stages read [N]. A kernel calls this once for each vertex, even if its force is zero. The reason:
// the first kernel of a stage replaces what an earlier stage has left.
void add_force(uint i, dvec3 force) {
  if (is_first == 0u) force += LOAD3(added_force, force_of(i));
  STORE3(added_force, force_of(i), force)
}
