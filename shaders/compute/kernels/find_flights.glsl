// One thread serves one body. It finds the first one of its island. The thread of that one finds the mean velocity of all, by their masses,
// and whether one of them breaks apart.
#include "../physics/body.glsl"
#include "../physics/contact/cluster.glsl"
READ(body)
READ(status)
WRITE(cluster)
PARAMETER(uint, body_count)

uint first_of_island(uint b) {
  for (uint earlier = ATOMIC_LOAD(cluster[b].island); earlier != b; earlier = ATOMIC_LOAD(cluster[b].island)) b = earlier;
  return b;
}

double mass_of(uint b) { return double(body[b].vertex_count) / body[b].inverse_mass; }

void find_flights(uint b) {
  if (status[b].activity == immovable) return;
  uint first = first_of_island(b);
  ATOMIC_STORE(cluster[b].island, first);
  if (b != first || cluster[b].has_company == 0u) return;
  dvec3 momentum = mass_of(b) * LOAD3(cluster[b].island_velocity, 0u);
  double mass = mass_of(b);
  for (uint other = b + 1u; other < body_count; ++other) {
    if (cluster[other].has_company == 0u || first_of_island(other) != first) continue;
    momentum += mass_of(other) * LOAD3(cluster[other].island_velocity, 0u);
    mass += mass_of(other);
    if (cluster[other].cannot_fly != 0u) cluster[b].cannot_fly = 1u;
  }
  dvec3 velocity = momentum / mass;
  STORE3(cluster[b].island_velocity, 0u, velocity)
}
