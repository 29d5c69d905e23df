// One thread serves one body at a step's end, when it is known whether proofs stopped its flight. The clock of its path goes on, or the
// body waits. It also finds whether the body may count as at rest. Steps that are empty or undone change nothing.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/parts.glsl"
#include "../physics/contact/surface.glsl"
#include "../physics/path.glsl"
READ(control)
READ(step_parts)
READ(contact_list)
READ(cluster)
READ(cut)
READ(path)
READ(path_key)
WRITE(path_state)
WRITE(status)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, contact_capacity)
#include "parts/full_lists.glsl"
#include "parts/flight.glsl"
#include "parts/stays.glsl"
#include "parts/point_on_path.glsl"

// A path that stands still for so many steps more may count as at rest. One that begins to move earlier than this sees is not at rest from
// the step on in which it moves, but wakes others one step late.
const double steps_ahead = double(8);

void end_paths(uint b) {
  if (status[b].activity != scripted) return;
  double h = control[0].time_step, before = path_state[b].time;
  if (h == double(0)) {
    status[b].disturbed = 1u;  // so that it does not count as a step at rest
    return;
  }
  bool waits = flight_was_stopped(b);
  if (!stays(b)) {
    path_state[b].time = path_state[b].next_time;
    path_state[b].now = path_state[b].next;
  }
  double time = path_state[b].time;
  if (waits || path_state[b].pace < double(1)) path_state[b].waited += h - (time - before);  // else only rounding differs
  path_state[b].waits += waits ? 1u : 0u;
  if (waits || time > before) path_state[b].pace = pace_after(path_state[b].pace, waits);
  if (!stands_still(path[b], time, time + steps_ahead * max(h, step_parts[0].full))) status[b].disturbed = 1u;
}
