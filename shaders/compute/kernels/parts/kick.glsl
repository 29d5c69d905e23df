// Returns a velocity component [m/s] after a kick of the given time [s] under a constant force [N] and gravity [m/s^2]. The kick is
// exact in the damping: v' = a - g v.
double kicked(IN(Body) material, double gravity, double force, double spring_force_squared, double velocity, double time) {
  EXACT double a = force * material.inverse_mass + gravity;
  Decay d = decay(damping_rate(damping_law, material.damping, material.inverse_mass, spring_force_squared) * time);
  EXACT double kicked_velocity = d.keep * velocity + (d.gain * time) * a;
  return kicked_velocity;
}
