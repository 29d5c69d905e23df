// Kicks vertex i of body b by the kept force and then drifts it, on axis k, first in a step of a splitting method.
PARAMETER(double, first_kick_time)   // [s]
PARAMETER(double, first_drift_time)  // [s]

struct Kicked {
  double relative;      // for the placement [m]
  double displacement;  // after the drift [m]
  double velocity;      // [m/s]
};

Decay first_decay(uint i, IN(Body) material) {
  dvec3 spring_force = LOAD3(kept_force, force_of(i));
  return decay_in_kick(material, ordered_dot(spring_force, spring_force), part_of_step() * first_kick_time);
}

Kicked first_kick_of(uint i, uint k, uint b, IN(Body) material, IN(Decay) d) {
  uint before = in_half(from_half, vertex_count, i);
  double displacement = motion[displacement_of(before) + k];
  Kicked done;
  done.velocity = kicked(material, gravity_of(b, k), all_force(i, k, kept_force[force_of(i) + k]), d, motion[velocity_of(before) + k],
                         part_of_step() * first_kick_time);
  EXACT double relative = (displacement - first_displacement(material.first_vertex, k)) +
                          part_of_step() * first_drift_time * (done.velocity - first_velocity(material.first_vertex, k));
  EXACT double drifted = displacement + part_of_step() * first_drift_time * done.velocity;
  done.relative = relative;
  done.displacement = drifted;
  return done;
}

void store_first_kick(uint i, uint k, IN(Body) material, IN(Kicked) done) {
  uint after = in_half(other_half(from_half), vertex_count, i);
  place(slot_of_force(0u), i, k, material.inverse_unit, double(rest_position[i][int(k)]), done.relative);
  motion[displacement_of(after) + k] = done.displacement;
  motion[velocity_of(after) + k] = done.velocity;
}
