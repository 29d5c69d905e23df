// The way in the step that a place in the world has in common with all of its body's cluster [m]. Distances stay, so that springs get no
// energy: a place goes along with the centre, and turns by Cayley's map of the spin, which is a rotation.
dvec3 way_of_cluster(uint b, double time_step, dvec3 from) {
  uint first = cluster[b].first;
  if (cluster[first].bodies == 0u) return dvec3(0);
  RigidMotion of_cluster = cluster[first].motion;
  dvec3 half_turn = (double(0.5) * time_step) * LOAD3(of_cluster.spin, 0u);
  dvec3 across = cross(half_turn, from - LOAD3(of_cluster.centre, 0u));
  dvec3 turn = (across + cross(half_turn, across)) * (double(2) / (double(1) + dot(half_turn, half_turn)));
  return time_step * LOAD3(of_cluster.velocity, 0u) + turn;
}

// Whether the body is in a cluster whose motion cuts leave alone.
bool has_common_way(uint b) {
  return cluster[body_count].bodies != 0u && cluster[cluster[b].first].bodies != 0u && cluster[cluster[b].first].is_low == 0u;
}

// What cuts leave alone of its way, if proofs do not stop the cluster [m].
dvec3 common_way(uint b, dvec3 from) { return has_common_way(b) ? way_of_cluster(b, control[0].time_step, from) : dvec3(0); }
