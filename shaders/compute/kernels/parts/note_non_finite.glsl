// Notes that vertex i of body b is not finite, or that its error ends the run. Needs the array `status` and the parameter `body_count`.
void note_non_finite(uint b, uint i) {
  atomicMin(status[b].non_finite_vertex, i);
  atomicMin(status[body_count].non_finite_vertex, i);
}
