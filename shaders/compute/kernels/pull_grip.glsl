// One thread changes the velocity of one vertex of a grip, after aim_pull.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
#include "../physics/pull.glsl"
READ(aim)
READ(grip)
WRITE(status)
WRITE(motion)
PARAMETER(uint, first_vertex)  // of the half that holds the state
#include "parts/rouse.glsl"

void pull_grip(uint g) {
  uint velocity = velocity_of(first_vertex + grip[g].vertex);
  for (uint k = 0u; k < 3u; ++k) motion[velocity + k] += double(grip[g].weight) * aim[0].change[k];
  rouse(aim[0].body);
  if (g == 0u) status[aim[0].body].slow_for = 0.0f;
}
