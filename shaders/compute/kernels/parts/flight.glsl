// Which motion cuts leave alone. Needs the arrays `cluster` and `control`.
#include "moves_as_one.glsl"

// Which flight the body has: those of clusters and scripted bodies come first, then those of islands.
uint flight_of(uint b) { return moves_as_one(b) ? cluster[b].first : body_count + cluster[b].island; }

// The way in the step that a place in the world has in common with all of its body's cluster, or of a scripted body [m]. Distances stay, so
// that springs get no energy: a place goes along with the centre, and turns by Cayley's map of the spin, which is a rotation.
dvec3 way_of_cluster(uint b, double time_step, dvec3 from) {
  RigidMotion of_cluster = cluster[cluster[b].first].motion;
  dvec3 half_turn = (double(0.5) * time_step) * LOAD3(of_cluster.spin, 0u);
  dvec3 across = cross(half_turn, from - LOAD3(of_cluster.centre, 0u));
  dvec3 turn = (across + cross(half_turn, across)) * (double(2) / (double(1) + dot(half_turn, half_turn)));
  return time_step * LOAD3(of_cluster.velocity, 0u) + turn;
}

// Whether the body's island may have a flight, before it is known whether a static triangle or a ground is in reach.
bool may_fly(uint b) { return cluster[cluster[b].island].cannot_fly == 0u; }

// That motion, as the way of a place in the world [m]. May be asked only if there is one.
dvec3 way_of_flight(uint b, double time_step, dvec3 from) {
  return moves_as_one(b) ? way_of_cluster(b, time_step, from) : time_step * LOAD3(cluster[cluster[b].island].island_velocity, 0u);
}

bool has_flight(uint b) { return may_fly(b) && cluster[cluster[b].island].is_beside_static == 0u; }

// What cuts leave alone of its way, if proofs do not stop the flight [m].
dvec3 flight_in_step(uint b, dvec3 from) { return has_flight(b) ? way_of_flight(b, control[0].time_step, from) : dvec3(0); }

// Whether two bodies have the same flight, which leaves their distances.
bool have_one_flight(uint a, uint b) { return flight_of(a) == flight_of(b); }
