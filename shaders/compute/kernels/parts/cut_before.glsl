// What part of its way a vertex may go by all rounds of proofs before this one, as bits of a float. Needs the array `cut`. Others may stop
// the vertex meanwhile, by this round's number, which is not before it.
uint cut_before(uint i, uint cut_round) {
  if (ATOMIC_LOAD(cut[stop_of(vertex_count, i)]) < cut_round) return 0u;
  uint least = cut[i];
  for (uint row = 1u; row <= min(cut_round, plane_rounds); ++row) least = min(least, cut[cut_in(row, vertex_count, i)]);
  return least;
}

// If its flight was stopped, a vertex goes on alone by such a part of all of its way. But none does of bodies that move as one, nor one
// that would have left its cage, which holds its way with the flight.
bool goes_on_alone(uint i, uint b) { return !moves_as_one(b) && uintBitsToFloat(cut[i]) == 1.0f; }
