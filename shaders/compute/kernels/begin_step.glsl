// One thread a body, first in a step whose length is not fixed: how long it is. With the target reached the body rests.
#include "../physics/body.glsl"
#include "../physics/pace.glsl"
READ(pace)
WRITE(frame)

void begin_step(uint b) {
  if (frame[b].halted != not_halted && frame[b].halted != halted_for_now) return;
  frame[b].time_step = next_step(pace[0]);
  frame[b].halted = frame[b].time_step > double(0) ? not_halted : halted_for_now;
  for (uint k = 0u; k < 3u; ++k) frame[b].start_reference[k] = frame[b].reference[k];
}
