// What force kernels share. For each share that runs(), the frame around them sums the springs of its vertices at the placements
// in placement_slot(), and counts that once a body. Around that it calls, for each vertex and axis, before_force(), whose loads
// hide behind the sum, after_force(), which returns the coordinate it came to, and, where it settles(), settle() with all three.
bool halted(IN(Share) s) { return status[s.body_index].activity != moving; }

// Where no vertex moves relative to another every spring is at rest, and the sum is left out; as where the body is halted, for the
// frame around may ask before it knows.
bool deformed(IN(Share) s) { return status[s.body_index].deformed != 0u && !halted(s); }

void count_force(IN(Share) s, bool summed) {
  if (summed)
    atomicAdd(tally[s.body_index].force_evaluations, 1u);
  else
    atomicAdd(tally[s.body_index].forces_skipped, 1u);
}
