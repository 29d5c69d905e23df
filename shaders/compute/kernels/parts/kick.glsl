// How the velocity of a vertex decays in a kick of the given time [s], on all axes alike. The springs' net force squared is in N^2.
Decay decay_in_kick(IN(Body) material, double spring_force_squared, double time) {
  return decay(damping_rate(damping_law, material.damping, material.inverse_mass, spring_force_squared) * time);
}

// Returns a velocity component [m/s] after a kick of the given time [s] under a constant force [N] and gravity [m/s^2]. The kick is
// exact in the damping: v' = a - g v.
double kicked(IN(Body) material, double gravity, double force, IN(Decay) d, double velocity, double time) {
  EXACT double a = force * material.inverse_mass + gravity;
  EXACT double kicked_velocity = d.keep * velocity + (d.gain * time) * a;
  return kicked_velocity;
}
