// The way in the step that a place in the world has in common with all of its body's cluster [m].
dvec3 way_of_cluster(uint b, double time_step, dvec3 from) {
  uint first = cluster[b].first;
  if (cluster[first].bodies == 0u) return dvec3(0);
  RigidMotion of_cluster = cluster[first].motion;
  return time_step * velocity_at(of_cluster, from);
}

// The same as far as cuts leave it alone.
dvec3 common_way(uint b, dvec3 from) {
  if (cluster[body_count].bodies == 0u || cluster[cluster[b].first].is_met != 0u) return dvec3(0);
  return way_of_cluster(b, control[0].time_step, from);
}
