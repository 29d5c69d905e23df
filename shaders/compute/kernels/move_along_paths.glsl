// One thread serves one vertex of a scripted body, in place of the integrator: the step ends where the body's path leads.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/path.glsl"
READ(control)
READ(status)
READ(pose)
READ(path_state)
READ(rest_position)
WRITE(motion)
WRITE(world_position)
PARAMETER(uint, vertex_count)
PARAMETER(uint, from_half)

void move_along_paths(uint i) {
  uint b = uint(rest_position[i].w);
  if (status[b].activity != scripted || control[0].time_step == double(0) || is_idle(status[b])) return;
  PathPoint next = path_state[b].next;
  dvec3 rest = dvec3(vec3(rest_position[i])), from_centre = rotate_by(quaternion_of(next), rest);
  dvec3 place = LOAD3(next.centre, 0u) + from_centre;
  dvec3 velocity = path_state[b].pace * rotate_back(pose[b], LOAD3(next.velocity, 0u) + cross(LOAD3(next.spin, 0u), from_centre));
  dvec3 displacement = rotate_back(pose[b], place - LOAD3(pose[b].origin, 0u)) - rest;
  uint after = in_half(other_half(from_half), vertex_count, i);
  STORE3(motion, displacement_of(after), displacement)
  STORE3(motion, velocity_of(after), velocity)
  world_position[after] = vec4(vec3(place), 1);
}
