// Restates the force that is kept for the next step.
void restate_force(uint i, uint b) {
  uint at = force_of(i);
  dvec3 kept = turned(b, LOAD3(kept_force, at));
  STORE3(kept_force, at, kept)
}
