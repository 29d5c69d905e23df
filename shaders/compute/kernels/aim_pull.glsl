// One thread in all finds how much the grip's velocity has to change so that the grip comes to the target. It runs between steps.
// It draws the mean velocity of some of the grip's vertices towards a bounded one, by no more than it lacks. This takes energy from
// all other motion.
#include "../physics/body.glsl"
#include "../physics/layout.glsl"
#include "../physics/pull.glsl"
WRITE(aim)
READ(grip)
READ(pose)
READ(status)
READ(world_position)
READ(motion)
PARAMETER(uint, first_vertex)  // of the half that holds the state

void aim_pull(uint item) {
  uint b = aim[item].body, sample_count = min(aim[item].grip_count, grip_sample_count);
  dvec3 place = dvec3(0), velocity = dvec3(0);
  double weights = double(0);
  for (uint k = 0u; k < sample_count; ++k) {
    GripVertex held = grip[k * aim[item].grip_count / sample_count];
    place += double(held.weight) * dvec3(vec3(world_position[first_vertex + held.vertex]));
    velocity += double(held.weight) * LOAD3(motion, velocity_of(first_vertex + held.vertex));
    weights += double(held.weight);
  }
  dvec3 way = LOAD3(aim[item].target, 0u) - place / weights;
  dvec3 wanted = rotate_back(pose[b], limited(aim[item].approach * way, aim[item].largest_speed));
  dvec3 change = limited(wanted - velocity / weights, aim[item].largest_change);
  if (status[b].activity != moving) change = dvec3(0);
  STORE3(aim[item].change, 0u, change)
}
