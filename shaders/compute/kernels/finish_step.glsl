// One thread adds this step's count of one counter to the run's. The first thread moves the clock, too.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
WRITE(control)
#include "parts/add_to_total.glsl"

void add_count(uint k) {
  uint count = control[0].count[k];
  if (k == contact_pairs) {
    if (count != 0u) control[0].contact_steps += 1u;
    control[0].contact_pairs_max = max(control[0].contact_pairs_max, count);
  }
  add_to_total(k, count);
  control[0].count[k] = 0u;
}

void move_clock() {
  control[0].near_pair_count = 0u;
  control[0].treelet_pair_count = 0u;
  control[0].leaf_pair_count = 0u;
  if (control[0].non_finite_step != 0u) return;
  if (control[0].non_finite_vertex != no_vertex) control[0].non_finite_step = control[0].step;
  control[0].step += 1u;
}

void finish_step(uint item) {
  if (item < counter_count) add_count(item);
  if (item == 0u) move_clock();
}
