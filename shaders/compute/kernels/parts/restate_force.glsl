// Restates the force that is kept for the next step.
void restate_force(uint i, uint b) {
  uint at = force_of(in_half(other_half(from_half), vertex_count, i));
  dvec3 kept = turned(b, LOAD3(kept_force, at));
  STORE3(kept_force, at, kept)
}
