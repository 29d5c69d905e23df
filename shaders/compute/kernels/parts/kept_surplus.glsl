// What is known of a vertex's surplus between steps, along axis k of the world. Quiet steps have to give the same bits as others.
#include "../../physics/contact/surplus.glsl"
WRITE(surplus)
PARAMETER(double, share_of_end)
PARAMETER(double, share_of_lead)  // 0: leads are not kept

Surplus kept_surplus(uint i, uint k) {
  Surplus kept;
  kept.expected = double(surplus[expected_surplus_of(i) + k]);
  kept.of_end = double(surplus[end_surplus_of(vertex_count, i) + k]);
  kept.lead = double(0);
  if (share_of_lead != double(0)) kept.lead = double(surplus[surplus_lead_of(vertex_count, i) + k]);
  return kept;
}

void store_surplus(uint i, uint k, IN(Surplus) known) {
  surplus[expected_surplus_of(i) + k] = real(known.expected);
  surplus[end_surplus_of(vertex_count, i) + k] = real(known.of_end);
  if (share_of_lead != double(0)) surplus[surplus_lead_of(vertex_count, i) + k] = real(known.lead);
}

// Returns what is kept after a step in which velocities grew so from its start to its mean, and from that to its end [m/s]. `before` is
// what was kept. The result is rounded as it is stored, since quiet steps and others have to go on from the same bits.
Surplus kept_surplus_after(IN(Surplus) before, double gained_at_start, double gained_at_end, double time_step) {
  Surplus known = surplus_after(gained_at_start, gained_at_end, before, time_step, share_of_end, share_of_lead);
  known.expected = double(real(known.expected));
  known.of_end = double(real(known.of_end));
  known.lead = double(real(known.lead));
  return known;
}
