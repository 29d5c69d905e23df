// One thread a vertex of a grip, after aim_pull: changes its velocity.
#include "../physics/body.glsl"
#include "../physics/pull.glsl"
READ(aim)
READ(grip)
WRITE(frame)
WRITE(motion)
PARAMETER(uint, first_vertex)  // of the half that holds the state

void pull_grip(uint g) {
  uint velocity = 6u * (first_vertex + grip[g].vertex) + 3u;
  for (uint k = 0u; k < 3u; ++k) motion[velocity + k] += double(grip[g].weight) * aim[0].change[k];
  ATOMIC_STORE(frame[aim[0].body].deformed, 1u);
}
