// One thread, or a few of them, find the contacts between the features of two triangles. Each vertex and edge belongs to one triangle, so
// that no two pairs find the same contact. All threads share the list of pairs in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/collision/box.glsl"
#include "../physics/contact/contact.glsl"
READ(control)
READ(rest_position)
READ(surface)
READ(triangle)
READ(triangle_around)
READ(cage)
READ(triangle_pair)
READ(start)
READ(expected)
READ(surplus)
READ(last_cut)
PARAMETER(uint, vertex_count)
PARAMETER(uint, triangle_pair_capacity)
PARAMETER(uint, threads_at_once)
PARAMETER(uint, most_threads_of_a_pair)

#include "parts/add_contact.glsl"
#include "parts/boxes_in_motion.glsl"

uint body_of(uint i) { return uint(rest_position[i].w); }

// What is the same for all contacts of a pair of triangles.
struct Pair {
  uint first;   // triangles, in leaf order
  uint second;
  uint vertex[6];
  real3 place[6];     // relative to the first corner [m]
  real3 way[6];       // expected in the step, relative to that of the first corner [m]
  real gap;
};

struct Feature {
  uvec4 corner;  // of the pair, 0 to 5
  real4 weight;
};

Pair pair_of(uvec2 triangles) {
  Pair p;
  p.first = triangles.x;
  p.second = triangles.y;
  for (uint k = 0u; k < 3u; ++k) {
    p.vertex[k] = triangle[corner_of(triangles.x, k)];
    p.vertex[3u + k] = triangle[corner_of(triangles.y, k)];
  }
  double h = control[0].time_step;
  dvec3 origin = LOAD3(start, start_position_of(p.vertex[0])), base = LOAD3(expected, force_of(p.vertex[0]));
  for (uint k = 0u; k < 6u; ++k) {
    p.place[k] = real3(LOAD3(start, start_position_of(p.vertex[k])) - origin);
    p.way[k] = real3(h * (LOAD3(expected, force_of(p.vertex[k])) - base));
  }
  p.gap = real(gap_of_pair(surface[body_of(p.vertex[0])], surface[body_of(p.vertex[3])]));
  return p;
}

real3 weighed(IN(Feature) f, IN_ARRAY(real3, values, 6)) {
  return f.weight.x * values[f.corner.x] + f.weight.y * values[f.corner.y] + f.weight.z * values[f.corner.z] +
         f.weight.w * values[f.corner.w];
}

// The same of [vertex][3] doubles, whose differences are taken before they are rounded. Weights sum to zero.
real3 weighed_differences(dvec3 x, dvec3 y, dvec3 z, dvec3 w, real4 weight) {
  return weight.y * real3(y - x) + weight.z * real3(z - x) + weight.w * real3(w - x);
}

// Weighs a vertex of one triangle against the other triangle. `side` is 1 for a vertex of the first, -1 for one of the second.
Feature vertex_and_triangle(uint corner, real side, IN_ARRAY(real3, p, 6)) {
  uint first = corner < 3u ? 3u : 0u;
  real3 w = closest_on_triangle(p[corner], p[first], p[first + 1u], p[first + 2u]);
  Feature f;
  f.corner = uvec4(corner, first, first + 1u, first + 2u);
  f.weight = side * real4(1, -w.x, -w.y, -w.z);
  return f;
}

// Where a vertex stands after this part of the step, relative to the pair's first corner.
real3 place_of(IN(Pair) p, uint i, real part) {
  dvec3 place = LOAD3(start, start_position_of(i)) - LOAD3(start, start_position_of(p.vertex[0]));
  dvec3 way = control[0].time_step * (LOAD3(expected, force_of(i)) - LOAD3(expected, force_of(p.vertex[0])));
  return real3(place) + part * real3(way);
}

// Slopes [m/m] by which features count as nearer than others. Where surfaces press each other flat, edges and faces are both held up to
// `flat_slope`. If one of the two were left out at once, the other would sink in until they changed places again, step by step.
const real flat_slope = real(1e-2);
const real least_slope = real(1e-5);

// Whether a point is nearer to a triangle than to its edge `along`. `third` leads from the edge to the triangle's third corner, and `away`
// from the edge's closest point to the point.
bool leans_over(real3 third, IN(real3) along, IN(real3) away, real slope) {
  third -= dot(third, along) / dot(along, along) * along;
  return dot(away, third) > slope * length(away) * length(third);
}

// The third vertex of the triangle across an edge of one of the pair's, or no_vertex. `face` is 0 for the first triangle.
uint vertex_across(IN(Pair) p, uint face, uint edge) {
  uint b = body_of(p.vertex[3u * face]), t = face == 0u ? p.first : p.second;
  uint beyond = triangle_around[across_edge_of(t + surface[b].to_mesh, edge)];
  return beyond == no_vertex ? no_vertex : surface[b].first_vertex + beyond;
}

// Whether a vertex is a corner of the other triangle of the pair, in a body that meets itself. Beyond an edge it does not say that faces
// there are nearer: a triangle has no contacts with its own corners, so no other pair would have this contact.
bool belongs_to_other(IN(Pair) p, uint face, uint i) {
  uint other = face == 0u ? 3u : 0u;
  return p.vertex[other] == i || p.vertex[other + 1u] == i || p.vertex[other + 2u] == i;
}

// Whether the triangle across an edge of one of the pair's is nearer to a point than the edge is.
bool is_nearer_across(IN(Pair) p, uint face, uint edge, IN_ARRAY(real3, places, 6), IN(real3) closest, IN(real3) away, real part,
                      real slope) {
  uint beyond = vertex_across(p, face, edge);
  if (beyond == no_vertex || belongs_to_other(p, face, beyond)) return false;
  uint from = 3u * face + edge, to = 3u * face + (edge == 2u ? 0u : edge + 1u);
  return leans_over(place_of(p, beyond, part) - closest, places[to] - places[from], away, slope);
}

// Whether an edge at a vertex leads towards a point. It is asked of static bodies alone: in a soft one pressed flat, vertices that lie a
// little deeper than their neighbours change from step to step, and all of them have to be held.
bool leads_to(IN(real3) edge, IN(real3) away) { return dot(away, edge) > flat_slope * length(away) * length(edge); }

// Whether a triangle or an edge at the vertex is nearer to a point than the vertex is. `away` leads from the vertex to the point. It looks
// at the vertex's own triangle and at those across its two edges.
bool is_nearer_to_its_faces(IN(Pair) p, uint corner, IN_ARRAY(real3, places, 6), IN(real3) away, real part) {
  uint face = corner / 3u, k = corner % 3u, before = k == 0u ? 2u : k - 1u, after = k == 2u ? 0u : k + 1u;
  if (leads_to(places[3u * face + before] - places[corner], away)) return true;
  if (leads_to(places[3u * face + after] - places[corner], away)) return true;
  uint across_next = vertex_across(p, face, k), across_last = vertex_across(p, face, before);
  if (across_next != no_vertex && leads_to(place_of(p, across_next, part) - places[corner], away)) return true;
  return across_last != no_vertex && leads_to(place_of(p, across_last, part) - places[corner], away);
}

// Whether other features of the two meshes are nearer to each other than the vertex and the triangle. Without this, what slides over a flat
// mesh would meet triangles ahead by tilted normals, and be braked.
bool is_nearer_to_others(IN(Pair) p, IN(Feature) f, IN_ARRAY(real3, places, 6), real part) {
  real3 w = -real3(f.weight.y, f.weight.z, f.weight.w) / f.weight.x;
  uint face = f.corner.y / 3u;
  real3 closest = w.x * places[f.corner.y] + w.y * places[f.corner.z] + w.z * places[f.corner.w];
  real3 away = places[f.corner.x] - closest;
  bool is_static = surface[uint(rest_position[p.vertex[f.corner.x]].w)].inverse_mass == double(0);
  if (is_static && is_nearer_to_its_faces(p, f.corner.x, places, -away, part)) return true;
  // edge k lies across from corner k + 2, so it has the point where that corner has no weight
  if (w.z == real(0) && is_nearer_across(p, face, 0u, places, closest, away, part, least_slope)) return true;
  if (w.x == real(0) && is_nearer_across(p, face, 1u, places, closest, away, part, least_slope)) return true;
  return w.y == real(0) && is_nearer_across(p, face, 2u, places, closest, away, part, least_slope);
}

Feature two_edges(uint j, uint k, IN_ARRAY(real3, p, 6), OUT(bool) crosses) {
  Feature f;
  f.corner = uvec4(j, j == 2u ? 0u : j + 1u, 3u + k, k == 2u ? 3u : 4u + k);
  Crossing at = crossing_of(p[f.corner.x], p[f.corner.y], p[f.corner.z], p[f.corner.w]);
  f.weight = real4(real(1) - at.on_first, at.on_first, at.on_second - real(1), -at.on_second);
  crosses = at.crosses;
  return f;
}

void add_contact(IN(Pair) p, IN(Feature) f, IN(real3) normal) {
  uvec4 who = uvec4(p.vertex[f.corner.x], p.vertex[f.corner.y], p.vertex[f.corner.z], p.vertex[f.corner.w]);
  dvec3 vx = LOAD3(start, start_velocity_of(who.x)), vy = LOAD3(start, start_velocity_of(who.y)),
        vz = LOAD3(start, start_velocity_of(who.z)), vw = LOAD3(start, start_velocity_of(who.w));
  dvec3 mx = LOAD3(expected, force_of(who.x)), my = LOAD3(expected, force_of(who.y)), mz = LOAD3(expected, force_of(who.z)),
        mw = LOAD3(expected, force_of(who.w));
  real3 velocity = weighed_differences(vx, vy, vz, vw, f.weight);
  real3 surplus_now = weighed_differences(mx - vx, my - vy, mz - vz, mw - vw, f.weight);
  real3 end_surplus =
      weighed_differences(LOAD3(surplus, end_surplus_of(vertex_count, who.x)), LOAD3(surplus, end_surplus_of(vertex_count, who.y)),
                          LOAD3(surplus, end_surplus_of(vertex_count, who.z)), LOAD3(surplus, end_surplus_of(vertex_count, who.w)),
                          f.weight);
  Surface first = surface[uint(rest_position[p.vertex[0]].w)], second = surface[uint(rest_position[p.vertex[3]].w)];
  Approach a;
  a.gap = p.gap;
  a.time_step = real(control[0].time_step);
  a.slowest = real(fastest_return(max(first.frequency, second.frequency)));
  a.elasticity = real(mean_of_pair(first.elasticity, second.elasticity));
  Course c;
  c.distance = dot(normal, weighed(f, p.place));
  c.velocity = dot(normal, velocity);
  c.surplus = dot(normal, surplus_now);
  c.was = c.velocity - real(contact_list[0].last_part) * dot(normal, end_surplus);
  c.was_cut = (last_cut[who.x] | last_cut[who.y] | last_cut[who.z] | last_cut[who.w]) != 0u;
  if (!is_near(c, a)) return;
  real3 goal = across(normal, -surplus_now - velocity);
  list_contact(who, f.weight, normal, c, a, goal, real(mean_of_pair(first.friction, second.friction)));
}

// A contact whose points are near each other now.
void consider(IN(Pair) p, IN(Feature) f) {
  real3 away = weighed(f, p.place);
  real distance = length(away);
  if (distance > real(0) && distance <= real(1.5) * p.gap) add_contact(p, f, away / distance);
}

// Returns the part of the step that is over when points have come near each other: 0 if they are near now, and below 0 if they will not be.
real comes_near_after(IN(Pair) p, IN(Feature) f) {
  real3 away = weighed(f, p.place);
  real distance = length(away);
  if (!(distance > real(1.5) * p.gap)) return real(0);
  real closing = -dot(away, weighed(f, p.way)) / distance;
  if (distance - closing >= real(1.5) * p.gap) return real(-1);
  return min((distance - p.gap) / closing, real(1));
}

// A normal that has turned further says that the points would pass each other.
const real least_cosine = real(0.8);

void consider_later(IN(Pair) p, IN(Feature) f, IN_ARRAY(real3, later, 6)) {
  real3 away = weighed(f, later), now = weighed(f, p.place);
  real distance = length(away);
  if (dot(away, now) > least_cosine * distance * length(now) && distance <= real(2) * p.gap) add_contact(p, f, away / distance);
}

// What is near now, but not the nearest, may be so later: surfaces slide.
const real look_again_after = real(0.5);  // of the step

void meet_vertex(IN(Pair) p, uint corner, real side) {
  Feature f = vertex_and_triangle(corner, side, p.place);
  real part = comes_near_after(p, f);
  bool near_now = part == real(0);
  if (near_now && !is_nearer_to_others(p, f, p.place, real(0))) {
    consider(p, f);
    return;
  }
  if (near_now) part = look_again_after;
  if (part < real(0)) return;
  real3 later[6];
  for (uint k = 0u; k < 6u; ++k) later[k] = p.place[k] + part * p.way[k];
  f = vertex_and_triangle(corner, side, later);
  if (!is_nearer_to_others(p, f, later, part)) consider_later(p, f, later);
}

// Whether a triangle at one of the two edges is nearer to the other edge's point. Then a vertex has the contact, and not these edges.
bool is_nearer_to_faces(IN(Pair) p, uint j, uint k, IN(Feature) f, IN_ARRAY(real3, places, 6), real part) {
  real3 on_first = f.weight.x * places[f.corner.x] + f.weight.y * places[f.corner.y];
  real3 on_second = -(f.weight.z * places[f.corner.z] + f.weight.w * places[f.corner.w]);
  real3 away = on_first - on_second;
  uint third_of_first = j == 0u ? 2u : j - 1u, third_of_second = k == 0u ? 5u : 2u + k;
  if (!belongs_to_other(p, 0u, p.vertex[third_of_first]) &&
      leans_over(places[third_of_first] - on_first, places[f.corner.y] - places[f.corner.x], -away, flat_slope))
    return true;
  if (!belongs_to_other(p, 1u, p.vertex[third_of_second]) &&
      leans_over(places[third_of_second] - on_second, places[f.corner.w] - places[f.corner.z], away, flat_slope))
    return true;
  return is_nearer_across(p, 0u, j, places, on_first, -away, part, flat_slope) ||
         is_nearer_across(p, 1u, k, places, on_second, away, part, flat_slope);
}

void meet_edges(IN(Pair) p, uint j, uint k) {
  bool crosses;
  Feature f = two_edges(j, k, p.place, crosses);
  real part = comes_near_after(p, f);
  bool near_now = part == real(0);
  if (near_now && crosses && !is_nearer_to_faces(p, j, k, f, p.place, real(0))) {
    consider(p, f);
    return;
  }
  if (near_now) part = look_again_after;
  if (part < real(0)) return;
  real3 later[6];
  for (uint n = 0u; n < 6u; ++n) later[n] = p.place[n] + part * p.way[n];
  f = two_edges(j, k, later, crosses);
  if (crosses && !is_nearer_to_faces(p, j, k, f, later, part)) consider_later(p, f, later);
}

// Returns the vertices and edges that belong to a triangle, as bits.
uint owned_by(uint t) { return triangle_around[owned_features_of(t + surface[body_of(triangle[corner_of(t, 0u)])].to_mesh)]; }

// Features 0 to 5 are the corners of both, and 6 to 14 pairs of their edges. Returns those that both triangles own, as bits.
uint owned_features(uvec2 triangles) {
  uint first = owned_by(triangles.x), second = owned_by(triangles.y);
  uint owned = (first & 7u) | (second & 7u) << 3u;
  for (uint j = 0u; j < 3u; ++j)
    if ((first >> (3u + j) & 1u) != 0u) owned |= second >> 3u << (6u + 3u * j);
  return owned;
}

// Returns those features of two triangles that share no vertex.
uint apart_features(IN(Pair) p) {
  uint apart = 0x7fffu;
  for (uint j = 0u; j < 3u; ++j)
    for (uint k = 0u; k < 3u; ++k) {
      if (p.vertex[j] != p.vertex[3u + k]) continue;
      uint edges_at_k = 1u << k | 1u << (k == 0u ? 2u : k - 1u);
      apart &= ~(1u << j | 8u << k | edges_at_k << (6u + 3u * j) | edges_at_k << (6u + 3u * (j == 0u ? 2u : j - 1u)));
    }
  return apart;
}

// Features of one body that are near each other at rest keep a gap that leaves them alone there.
const real share_of_rest = real(0.4);
real gap_at_rest(IN(Pair) p, uint feature) {
  real3 rest[6];
  for (uint k = 0u; k < 6u; ++k) rest[k] = real3(vec3(rest_position[p.vertex[k]]));
  bool crosses;
  Feature f;
  if (feature < 6u)
    f = vertex_and_triangle(feature, real(1), rest);
  else
    f = two_edges((feature - 6u) / 3u, (feature - 6u) % 3u, rest, crosses);
  return share_of_rest * length(weighed(f, rest));
}

void meet_feature(IN(Pair) p, uint feature) {
  if (feature < 6u)
    meet_vertex(p, feature, feature < 3u ? real(1) : real(-1));
  else
    meet_edges(p, (feature - 6u) / 3u, (feature - 6u) % 3u);
}

// Returns those of the wanted features whose ways come near each other, as far as the boxes of the corners' ways tell.
uint near_features(uvec2 triangles, uint wanted) {
  PaddedBox first[3], second[3];
  for (uint k = 0u; k < 3u; ++k) {
    first[k] = way_of_corner(triangles.x, k);
    second[k] = way_of_corner(triangles.y, k);
  }
  PaddedBox edges[3];
  for (uint k = 0u; k < 3u; ++k) edges[k] = joined(second[k], second[k == 2u ? 0u : k + 1u]);
  PaddedBox all_first = joined(joined(first[0], first[1]), first[2]), all_second = joined(edges[0], second[2]);
  uint near = 0u;
  for (uint k = 0u; k < 3u; ++k) {
    if (overlaps(first[k], all_second)) near |= 1u << k;
    if (overlaps(second[k], all_first)) near |= 8u << k;
  }
  for (uint j = 0u; j < 3u; ++j) {
    if ((wanted >> (6u + 3u * j) & 7u) == 0u) continue;
    PaddedBox edge = joined(first[j], first[j == 2u ? 0u : j + 1u]);
    for (uint k = 0u; k < 3u; ++k)
      if (overlaps(edge, edges[k])) near |= 1u << (6u + 3u * j + k);
  }
  return near & wanted;
}

// Meets the features `first`, `first` + `threads` and so on.
void meet(uvec2 triangles, uint first, uint threads) {
  uint mine = 0u;
  for (uint feature = first; feature < 15u; feature += threads) mine |= 1u << feature;
  uint wanted = owned_features(triangles) & mine;
  if (wanted == 0u) return;
  wanted = near_features(triangles, wanted);
  if (wanted == 0u) return;
  Pair p = pair_of(triangles);
  bool is_own = body_of(p.vertex[0]) == body_of(p.vertex[3]);
  if (is_own) wanted &= apart_features(p);
  real gap = p.gap;
  for (uint feature = 0u; feature < 15u; ++feature) {  // each thread passes over others', so a subgroup takes the same branches
    if ((wanted >> feature & 1u) == 0u) continue;
    if (is_own) p.gap = min(gap, gap_at_rest(p, feature));
    meet_feature(p, feature);
  }
}

// Lists of pairs that leave threads over get 4 or 16 for each pair: on a GPU a pass takes as long as its slowest thread.
uint threads_of_a_pair(uint count) {
  uint threads = most_threads_of_a_pair;
  while (threads > 1u && count > threads_at_once / threads) threads /= 4u;
  return threads;
}

void find_contacts(uint item) {
  if (control[0].time_step == double(0)) return;
  uint count = min(contact_list[0].triangle_pair_count, triangle_pair_capacity), threads = threads_of_a_pair(count);
  for (uint k = item / threads; k < count; k += threads_at_once / threads) {
    uvec2 pair = triangle_pair[k];
    if ((pair.y & ways_meet) != 0u) meet(uvec2(pair.x, pair.y & ~ways_meet), item % threads, threads);
  }
}
