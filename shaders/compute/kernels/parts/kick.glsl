// The velocity after a kick of the given time under a constant spring force, exact in the damping: v' = a - g v.
dvec3 kicked(uint b, real3 spring_force, dvec3 velocity, double time) {
  dvec3 net_force = dvec3(spring_force);
  dvec3 a = net_force / body[b].vertex_mass + LOAD3(frame[b].gravity, 0u);
  double rate = damping_rate(damping_law, body[b].damping, body[b].vertex_mass, length(net_force));
  Decay d = decay(rate * time);
  return d.keep * velocity + (d.gain * time) * a;
}
