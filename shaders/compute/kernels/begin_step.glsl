// One thread prepares one body, first in a step whose length is not fixed. The first thread sets the step's length. If the target is
// reached, the body rests.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/pace.glsl"
READ(pace)
WRITE(control)
WRITE(pose)
WRITE(status)

void begin_step(uint b) {
  double step = next_step(pace[0]);
  if (b == 0u) {
    control[0].time_step = step;
    control[0].time_left = pace[0].target - pace[0].time;
  }
  if (status[b].activity != moving && status[b].activity != halted_for_now) return;
  status[b].activity = step > double(0) ? moving : halted_for_now;
  for (uint k = 0u; k < 3u; ++k) pose[b].start_reference[k] = pose[b].reference[k];
}
