// A velocity component after a kick of the given time under a constant spring force, exact in the damping: v' = a - g v.
double kicked(IN(Body) material, double gravity, double spring_force, double force_squared, double velocity, double time) {
  double a = spring_force * material.inverse_mass + gravity;
  Decay d = decay(damping_rate(damping_law, material.damping, material.inverse_mass, force_squared) * time);
  return d.keep * velocity + (d.gain * time) * a;
}
