// The net spring force on vertex i, gathered over its body in a fixed order [N]. Reads `stage` from `stage_begin` on.
// Short sums, added up with Kahan's compensation: in fp32 the rounding error stays near 3e-8 of the force whatever the body's
// size. (Sums of 256 added plainly leave 2e-7, which a free oscillation of 100 rad shows as 1e-6.)
real3 net_spring_force(uint i, uint first, uint count, real stiffness, uint stage_begin) {
  real3 rest = real3(rest_position[i]);
  real3 moved = real3(stage[stage_begin + i]);
  EXACT real3 total = real3(0);
  EXACT real3 excess = real3(0);  // what `total` holds beyond the sum, by rounding
  for (uint begin = first; begin < first + count; begin += 16u) {
    uint end = min(begin + 16u, first + count);
    real3 sum = real3(0);
    for (uint j = begin; j < end; ++j)
      sum += spring_elongation(rest - real3(rest_position[j]), moved - real3(stage[stage_begin + j]));
    EXACT real3 added = sum - excess;
    EXACT real3 grown = total + added;
    excess = (grown - total) - added;
    total = grown;
  }
  return -stiffness * total;
}

// ... or zero without summing, where no vertex has moved relative to another. Counts once per body.
real3 body_spring_force(uint i, uint b, uint stage_begin) {
  bool counts = i == body[b].first_vertex;
  if (frame[b].deformed == 0u) {
    if (counts) frame[b].forces_skipped += 1u;
    return real3(0);
  }
  if (counts) frame[b].force_evaluations += 1u;
  return net_spring_force(i, body[b].first_vertex, body[b].vertex_count, real(body[b].stiffness), stage_begin);
}
