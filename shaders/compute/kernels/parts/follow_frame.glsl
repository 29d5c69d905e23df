// Restates what vertex i of body b has, if the body's frame has turned. World positions stay as stored.
PARAMETER(uint, keeps_force)  // 1: the method keeps spring forces for the next step
#include "restate.glsl"
#include "restate_force.glsl"

void follow_frame(uint i, uint b) {
  if (frame_change[b].turned == 0u) return;
  restate(i, b, body[b].inverse_unit);
  if (keeps_force != 0u) restate_force(i, b);
}
