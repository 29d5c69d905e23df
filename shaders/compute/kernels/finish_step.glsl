// One thread: adds this step's counts to the run's, and moves the clock.
#include "../physics/control.glsl"
WRITE(0, Controls, Control, control)

void finish_step(uint item) {
  if (item != 0u || control[0].non_finite_step != 0u) return;
  control[0].count[triangle_tests] += control[0].candidate_count;
  if (control[0].non_finite_vertex != no_vertex) control[0].non_finite_step = control[0].step;
  if (control[0].count[contact_pairs] != 0u) control[0].contact_steps += 1u;
  control[0].contact_pairs_max = max(control[0].contact_pairs_max, control[0].count[contact_pairs]);
  for (uint k = 0u; k < counter_count; ++k) {
    uint before = control[0].total_low[k];
    control[0].total_low[k] = before + control[0].count[k];
    if (control[0].total_low[k] < before) control[0].total_high[k] += 1u;
    control[0].count[k] = 0u;
  }
  control[0].turn_groups[0] = 0u;
  control[0].refresh_groups[0] = 0u;
  control[0].refit_groups[0] = 0u;
  control[0].find_groups[0] = 0u;
  control[0].test_groups[0] = 0u;
  control[0].respond_groups[0] = 0u;
  control[0].near_pair_count = 0u;
  control[0].candidate_count = 0u;
  control[0].step += 1u;
}
