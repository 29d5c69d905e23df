// What force kernels share. For each share that runs(), the frame around them sums the springs of its vertices. It takes the placements
// in placement_slot(), and counts the sum once a body. For each vertex it calls damping_by(), with the square of the springs' net force
// [N^2]; threads that serve an axis each all do. For each vertex and axis it also calls these:
// - before_force(), whose loads hide behind the sum
// - after_force(), which returns the coordinate it came to
// - settle() with all three coordinates, if the kernel settles()
#ifdef GIVEN_SUMS
READ(spring_sum)
#endif
PARAMETER(uint, first_share)  // of those that this variant serves
PARAMETER(uint, skips)

bool halted(IN(Share) s) { return status[s.body_index].activity != moving || is_still(status[s.body_index]); }

// Whether springs have to be summed. If no vertex moves relative to another, every spring is at rest. Halted bodies and those at
// rest need no sum either, and the frame around may ask before it knows that a body is halted.
bool deformed(IN(Share) s) { return (status[s.body_index].deformed != 0u || (skips & skips_forces) == 0u) && !halted(s); }

#if defined QUIET || defined COUNTS_NOTHING
void count_force(IN(Share) s, bool summed) {}  // others count
#else
void count_force(IN(Share) s, bool summed) {
  if (summed)
    atomicAdd(tally[s.body_index].force_evaluations, 1u);
  else
    atomicAdd(tally[s.body_index].forces_skipped, 1u);
}
#endif
