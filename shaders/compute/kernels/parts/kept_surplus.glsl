// Where the surplus of a vertex is kept between steps, along axis k of the world. Kernels that use it have the same bits in quiet steps,
// which all have one length.
WRITE(surplus)

Surplus kept_surplus(uint i, uint k) {
  Surplus kept;
  kept.expected = surplus[expected_surplus_of(i) + k];
  kept.of_end = surplus[end_surplus_of(vertex_count, i) + k];
  kept.lead = surplus[surplus_lead_of(vertex_count, i) + k];
  return kept;
}

void store_surplus(uint i, uint k, IN(Surplus) known) {
  surplus[expected_surplus_of(i) + k] = known.expected;
  surplus[end_surplus_of(vertex_count, i) + k] = known.of_end;
  surplus[surplus_lead_of(vertex_count, i) + k] = known.lead;
}
