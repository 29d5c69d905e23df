bool is_in_cluster(uint b) { return cluster[body_count].bodies != 0u && cluster[cluster[b].first].bodies != 0u; }

// The entry that says how the body flies: that of its cluster's first one, or its own.
uint flight_of(uint b) { return is_in_cluster(b) ? cluster[b].first : b; }

// The way in the step that a place in the world has in common with all of its body's cluster [m]. Distances stay, so that springs get no
// energy: a place goes along with the centre, and turns by Cayley's map of the spin, which is a rotation.
dvec3 way_of_cluster(uint b, double time_step, dvec3 from) {
  RigidMotion of_cluster = cluster[cluster[b].first].motion;
  dvec3 half_turn = (double(0.5) * time_step) * LOAD3(of_cluster.spin, 0u);
  dvec3 across = cross(half_turn, from - LOAD3(of_cluster.centre, 0u));
  dvec3 turn = (across + cross(half_turn, across)) * (double(2) / (double(1) + dot(half_turn, half_turn)));
  return time_step * LOAD3(of_cluster.velocity, 0u) + turn;
}

// The velocity that a body has in common with those near it [m/s].
double velocity_of_flight(uint b, uint k) {
  return double(0.5) * (double(from_ordered_bits(cluster[b].least_flight[k])) + double(from_ordered_bits(cluster[b].most_flight[k])));
}
dvec3 velocity_of_flight(uint b) { return dvec3(velocity_of_flight(b, 0u), velocity_of_flight(b, 1u), velocity_of_flight(b, 2u)); }

// Whether cuts leave a motion of the body alone, but for grounds near it.
bool may_fly(uint b) {
  if (cluster[flight_of(b)].is_beside_static != 0u) return false;
  return is_in_cluster(b) || cluster[b].least_flight[0] <= cluster[b].most_flight[0];
}

// That motion, as the way of a place in the world [m]. May be asked only if there is one.
dvec3 way_of_flight(uint b, double time_step, dvec3 from) {
  return is_in_cluster(b) ? way_of_cluster(b, time_step, from) : time_step * velocity_of_flight(b);
}

bool has_flight(uint b) { return may_fly(b) && cluster[flight_of(b)].is_low == 0u; }

// What cuts leave alone of its way, if proofs do not stop the flight [m].
dvec3 flight_in_step(uint b, dvec3 from) { return has_flight(b) ? way_of_flight(b, control[0].time_step, from) : dvec3(0); }

// Whether two bodies have the same flight, which leaves their distances.
bool have_one_flight(uint a, uint b) {
  if (is_in_cluster(a) || is_in_cluster(b)) return is_in_cluster(a) && is_in_cluster(b) && cluster[a].first == cluster[b].first;
  bool same = true;
  for (uint k = 0u; k < 3u; ++k)
    same = same && cluster[a].least_flight[k] == cluster[b].least_flight[k] && cluster[a].most_flight[k] == cluster[b].most_flight[k];
  return same;
}
