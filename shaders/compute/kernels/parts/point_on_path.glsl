// Where a path leads. Needs the array `path_key`.

double time_along_keys(IN(Path) p, double time) {
  return time_along(p, time, path_key[p.first_key].time, path_key[p.first_key + p.key_count - 1u].time);
}

// The key before a time between keys, or at it. It is not the last one.
uint key_before(IN(Path) p, double time) {
  uint before = p.first_key, end = p.first_key + p.key_count - 1u;
  while (end - before > 1u) {
    uint middle = before + (end - before) / 2u;
    if (path_key[middle].time <= time)
      before = middle;
    else
      end = middle;
  }
  return before;
}

PathPoint point_on_path(IN(Path) p, double time) {
  double at = time_along_keys(p, time);
  uint k = key_before(p, at);
  return point_of_body(p, point_between(path_key[k], path_key[k + 1u], at), time);
}

// Whether nothing moves from one key to the next.
bool is_hold(IN(PathKey) a, IN(PathKey) b) {
  bool stays = LOAD3(a.position, 0u) == LOAD3(b.position, 0u) && LOAD3(a.velocity, 0u) == dvec3(0) && LOAD3(b.velocity, 0u) == dvec3(0);
  bool turns = LOAD3(a.quaternion, 0u) != LOAD3(b.quaternion, 0u) || a.quaternion[3] != b.quaternion[3];
  bool begins = LOAD3(a.quaternion_rate, 0u) != dvec3(0) || a.quaternion_rate[3] != double(0);
  bool ends = LOAD3(b.quaternion_rate, 0u) != dvec3(0) || b.quaternion_rate[3] != double(0);
  return stays && !turns && !begins && !ends;
}

// Whether the path stands still from one time to another. One that begins anew until then counts as moving.
bool stands_still(IN(Path) p, double from, double to) {
  if (LOAD3(p.drift, 0u) != dvec3(0)) return false;
  uint last = p.first_key + p.key_count - 1u;
  if (p.repeats == 0u && from >= path_key[last].time) return true;
  double begin = time_along_keys(p, from), end = p.repeats != 0u ? begin + (to - from) : min(to, path_key[last].time);
  if (end > path_key[last].time) return false;
  if (end < path_key[p.first_key].time) return true;
  for (uint k = key_before(p, begin); k < last && path_key[k].time <= end; ++k)
    if (!is_hold(path_key[k], path_key[k + 1u])) return false;
  return true;
}
