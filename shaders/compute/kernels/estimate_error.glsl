// One thread finds the error of one vertex after the last stage: how far the step's end is from those of the embedded methods. The
// largest error is exact in any order, because bits of floats that are not negative order as the floats do. NaN is above infinity.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/pace.glsl"
WRITE(pace)
READ(control)
WRITE(status)
READ(rest_position)
READ(acceleration)
READ(error_weight)
READ(error_scale)
PARAMETER(uint, vertex_count)
PARAMETER(uint, body_count)
PARAMETER(uint, stage_count)
#include "parts/note_non_finite.glsl"

uint bits_of(dvec3 difference) { return floatBitsToUint(float(sqrt(dot(difference, difference)))) & 0x7fffffffu; }

void estimate_error(uint i) {
  uint b = uint(rest_position[i].w);
  if (status[b].activity != moving || is_still(status[b])) return;
  dvec3 position = dvec3(0), velocity = dvec3(0), second_position = dvec3(0), second_velocity = dvec3(0);
  for (uint stage = 0u; stage < stage_count; ++stage) {
    dvec3 a = LOAD3(acceleration, acceleration_of(stage, vertex_count, i));
    uint weight = error_weights_of(stage);
    position += error_weight[weight] * a;
    velocity += error_weight[weight + 1u] * a;
    second_position += error_weight[weight + 2u] * a;
    second_velocity += error_weight[weight + 3u] * a;
  }
  double h = control[0].time_step;
  double of_position = h * h * error_scale[error_scales_of(b)], of_velocity = h * error_scale[error_scales_of(b) + 1u];
  uint first = max(bits_of(of_position * position), bits_of(of_velocity * velocity));
  uint second = max(bits_of(of_position * second_position), bits_of(of_velocity * second_velocity));
  uint error = joined_error(first, second);
  RAISE_TO(pace[0].error, error)
  // If the error ends the run, the first such vertex is noted. If the step is undone, so is the note.
  if (failure_of(pace[0], h, error) != no_failure) note_non_finite(b, i);
}
