// All of a vertex's force on axis k [N]. Steps with forces beside the springs are never quiet.
#ifdef QUIET
double all_force(uint i, uint k, double spring_force) { return spring_force; }
#else
READ(added_force)
PARAMETER(uint, adds_force)  // 1: there are forces beside the springs
double all_force(uint i, uint k, double spring_force) {
  return adds_force != 0u ? spring_force + added_force[force_of(i) + k] : spring_force;
}
#endif
