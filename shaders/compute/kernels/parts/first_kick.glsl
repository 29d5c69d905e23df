// Kicks vertex i of body b by the kept force and then drifts it, on axis k, first in a step of a splitting method.
PARAMETER(double, first_kick_time)   // [s]
PARAMETER(double, first_drift_time)  // [s]
void kick_first(uint i, uint k, uint b, IN(Body) material) {
  uint before = in_half(from_half, vertex_count, i), after = in_half(other_half(from_half), vertex_count, i);
  dvec3 spring_force = LOAD3(kept_force, kept_force_of(from_half, i));
  double displacement = motion[displacement_of(before) + k];
  double velocity = kicked(material, gravity_of(b, k), all_force(i, k, spring_force[int(k)]), ordered_dot(spring_force, spring_force),
                           motion[velocity_of(before) + k], part_of_step() * first_kick_time);
  EXACT double relative = (displacement - first_displacement(material.first_vertex, k)) +
                          part_of_step() * first_drift_time * (velocity - first_velocity(material.first_vertex, k));
  place(slot_of_force(0u), i, k, material.inverse_unit, double(rest_position[i][int(k)]), relative);
  EXACT double drifted = displacement + part_of_step() * first_drift_time * velocity;
  motion[displacement_of(after) + k] = drifted;
  motion[velocity_of(after) + k] = velocity;
}
