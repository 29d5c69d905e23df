// A kernel in rounds. One thread serves one body, and finds the first one of its island. All bodies of an island add up their momenta and
// masses there. The sums are whole numbers, so their order does not matter. If one of the bodies breaks apart, their island has no flight.
// If one of them moves or is disturbed, all are disturbed.
#include "../physics/body.glsl"
#include "../physics/contact/cluster.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/surface.glsl"
READ(body)
WRITE(status)
SHARED_WRITE(contact_list)
SHARED_WRITE(cluster)
SHARED_WRITE(island_scale)
SHARED_WRITE(island_sum)
PARAMETER(uint, body_count)

const uint last_round = 2u;
uint items_in_a_round() { return cluster[body_count].has_company != 0u ? body_count : 0u; }
uint rounds_at_most() { return last_round + 1u; }
bool goes_on(uint number) { return number < last_round; }

double mass_of(uint b) { return double(body[b].vertex_count) / body[b].inverse_mass; }

uint first_of_island(uint b) {
  for (uint earlier = ATOMIC_LOAD(cluster[b].island); earlier != b; earlier = ATOMIC_LOAD(cluster[b].island)) b = earlier;
  return b;
}

// Sums are counted in 2^-40 of the largest mass, and of that times the largest component of a velocity.
double scale_of(uint first, uint of) { return double(uintBitsToFloat(island_scale[2u * first + of])); }
double of_quanta(uint first, uint sum) { return whole_of(island_sum[4u * first + sum]) / double(1099511627776.0); }
double in_quanta(double part) { return nearest_whole(part * double(1099511627776.0)); }

void find_first(uint b) {
  uint first = first_of_island(b);
  ATOMIC_STORE(cluster[b].island, first);
  if (status[b].calm < quiet || status[b].disturbed != 0u) ATOMIC_STORE(cluster[first].is_disturbed, 1u);
  if (cluster[b].cannot_fly != 0u) {
    ATOMIC_STORE(cluster[first].cannot_fly, 1u);
    return;
  }
  dvec3 velocity = abs(LOAD3(cluster[b].island_velocity, 0u));
  uint mass = floatBitsToUint(float(mass_of(b))), fastest = floatBitsToUint(float(max(velocity.x, max(velocity.y, velocity.z))));
  RAISE_TO(island_scale[2u * first], mass)
  RAISE_TO(island_scale[2u * first + 1u], fastest)
}

void add_to_island(uint b) {
  uint first = cluster[b].island;
  double fastest = scale_of(first, 1u), part = mass_of(b) / scale_of(first, 0u);
  ADD_EXACTLY(island_sum[4u * first + 3u], in_quanta(part))
  if (fastest == double(0)) return;
  dvec3 velocity = LOAD3(cluster[b].island_velocity, 0u) / fastest;
  for (uint k = 0u; k < 3u; ++k) ADD_EXACTLY(island_sum[4u * first + k], in_quanta(part * velocity[int(k)]))
}

// Empties the sums, too.
void end_island(uint first) {
  dvec3 sum = dvec3(of_quanta(first, 0u), of_quanta(first, 1u), of_quanta(first, 2u));
  dvec3 velocity = sum * (scale_of(first, 1u) / max(of_quanta(first, 3u), double(1e-12)));
  STORE3(cluster[first].island_velocity, 0u, velocity)
  for (uint k = 0u; k < 4u; ++k) island_sum[4u * first + k] = uvec2(0u);
  island_scale[2u * first] = island_scale[2u * first + 1u] = 0u;
}

void find_flights(uint b, uint number) {
  if (status[b].activity == immovable || cluster[b].has_company == 0u) return;
  if (number == 0u) find_first(b);
  if (number == 1u && cluster[cluster[b].island].cannot_fly == 0u) add_to_island(b);
  if (number == 1u && cluster[cluster[b].island].is_disturbed != 0u) status[b].disturbed = 1u;
  if (number == 2u && b == cluster[b].island) end_island(b);
}
