// A velocity component after a kick of the given time under a constant force, exact in the damping: v' = a - g v.
double kicked(IN(Body) material, double gravity, double force, double spring_force_squared, double velocity, double time) {
  double a = force * material.inverse_mass + gravity;
  Decay d = decay(damping_rate(damping_law, material.damping, material.inverse_mass, spring_force_squared) * time);
  return d.keep * velocity + (d.gain * time) * a;
}
