// What force kernels with several stages a step declare alike. A dispatch runs the stage that the parameter names. With TILE it runs
// all of them, and the frame around counts. Placements are then read past caches, because other groups write them meanwhile. With QUIET
// it runs all stages of many quiet steps. The frame around counts steps, too, and other groups write frames meanwhile.
const uint refresh_stage = ~0u;  // comes before stage 0, and sums the springs at the step's start for the first kick
#ifdef TILE
uint stage_index = 0u;
SHARED_WRITE_AS(placement, real4, placed)
SHARED_WRITE(placement)
WRITE(meeting)
#else
PARAMETER(uint, stage_index)
READ_AS(placement, real4, placed)  // for reading only, which GPUs cache better
WRITE(placement)
#endif
#ifdef QUIET
#include "../../physics/quiet.glsl"
#include "../../physics/rotation.glsl"
uint from_half = 0u;
uint step_index = 0u;
SHARED_WRITE(pose)
SHARED_WRITE(motion)
SHARED_WRITE(quiet_body)
WRITE(quiet_steps)
#include "quiet_frame.glsl"
#include "quiet_bound.glsl"
#else
PARAMETER(uint, from_half)
WRITE(pose)
WRITE(motion)
WRITE(tally)
WRITE(body_box)
#include "frame.glsl"
#include "bound.glsl"
void tell_reference(uint b, uint k, double reference) { pose[b].reference[k] = reference; }
#endif
PARAMETER(uint, stage_count)
CONSTANTS(tableau, tableau_size)
bool is_last() { return stage_index + 1u == stage_count; }
