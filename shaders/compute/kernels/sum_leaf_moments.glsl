// A group kernel. It takes the vertices of a tile of leaves into the tree's order, and sums the moments of each leaf. It runs before a stage.
#include "../physics/body.glsl"
#include "../physics/forces/clusters.glsl"
#include "../physics/layout.glsl"
READ(body)
READ(status)
READ(rest_position)
READ_AS(placement, real4, placed)
READ(spring_cluster)
READ(spring_leaf)
READ(tree_vertex)
WRITE_AS(spring_point, real4, point)
WRITE(leaf_moment)
PARAMETER(uint, vertex_count)
PARAMETER(uint, slot)
#include "parts/sums_leaf.glsl"
NEAR(double, part, bank_moments * places_of_tile)  // [place][12]

// `near_at` says where its moments go.
void take_place(uint leaf, uint place, uint near_at) {
  uvec4 own = spring_leaf[leaf];
  uint i = tree_vertex[place];
  real weight = place - leaf_size * leaf < spring_cluster[own.y].vertex_count ? real(1) : real(0);
  real3 x = real3(placed[position_at(slot, vertex_count, i)]), u = real3(placed[displacement_at(slot, vertex_count, i)]);
  dvec3 rest = dvec3(rest_position[i]) * body[own.x].inverse_unit, moved = dvec3(weight * u);
  point[place_of_point(place)] = real4(x, weight);
  point[displacement_of_point(place)] = real4(u, real(0));
  STORE3(part, near_at, moved)
  STORE3(part, near_at + 3u, rest.x * moved)
  STORE3(part, near_at + 6u, rest.y * moved)
  STORE3(part, near_at + 9u, rest.z * moved)
}

void sum_leaf_moments(uint tile) {
  for (uint k = THREAD; k < places_of_tile; k += THREADS) {
    uint place = leaf_size * first_leaf + places_of_tile * tile + k;
    if (sums_leaf(place / leaf_size)) take_place(place / leaf_size, place, bank_moments * k);
  }
  MEET
  for (uint k = THREAD; k < leaves_of_tile * moments_size; k += THREADS) {
    uint leaf = first_leaf + leaves_of_tile * tile + k / moments_size, first = bank_moments * leaf_size * (k / moments_size) + k % moments_size;
    if (!sums_leaf(leaf)) continue;
    double sum = double(0);
    for (uint v = 0u; v < leaf_size; ++v) sum += part[first + bank_moments * v];
    leaf_moment[moments_size * leaf + k % moments_size] = sum;
  }
}
