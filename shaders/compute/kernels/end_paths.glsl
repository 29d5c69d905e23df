// One thread serves one body at a step's end, when it is known whether proofs stopped its flight. The clock of its path goes on, or the
// body waits. It also finds whether the body may count as at rest.
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

// The next step is no longer than so many of the scene's. With a tolerance it grows by less in one step.
const double steps_ahead = double(8);

void end_paths(uint b) {
  if (status[b].activity != scripted) return;
  double h = control[0].time_step, pace = path_state[b].pace, time = path_state[b].time;
  bool waits = h > double(0) && stays(b);
  if (!waits) time += pace * h;
  path_state[b].time = time;
  path_state[b].waited += (waits ? double(1) : double(1) - pace) * h;
  path_state[b].waits += waits ? 1u : 0u;
  if (h > double(0)) path_state[b].pace = pace_after(pace, waits);
  if (!stands_still(path[b], time, time + steps_ahead * max(h, step_parts[0].full))) status[b].disturbed = 1u;
}
