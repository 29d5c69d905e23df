// What moves a body beside the integrator rouses it: it is not at rest, and wakes at the step's end if it sleeps. Needs the array `status`.
void rouse(uint b) {
  ATOMIC_STORE(status[b].deformed, 1u);
  ATOMIC_STORE(status[b].calm, 0u);
  ATOMIC_STORE(status[b].disturbed, 1u);
}
