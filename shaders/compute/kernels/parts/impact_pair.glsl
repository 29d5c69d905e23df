// Who keeps an impact of two bodies, and in which unit its impulses count. Needs the array `surface`, and the parameters `body_count` and
// `least_speed`. body_count stands for all grounds.
double inverse_vertex_mass(uint b) { return b < body_count ? surface[b].inverse_mass : double(0); }
bool is_movable(uint b) { return inverse_vertex_mass(b) > double(0); }

// An impact's impulses are counted in 1/1024 of what a vertex of the lighter body has at `least_speed` [Ns]. One that can't move counts for
// nothing here, and so do the grounds.
double impact_unit(uint a, uint b) { return least_speed / (double(1024) * max(inverse_vertex_mass(a), inverse_vertex_mass(b))); }

// Which of two bodies keeps their impact: the smaller one of those that can move.
uint keeper_of_impact(uint a, uint b) {
  if (!is_movable(b)) return a;
  if (!is_movable(a)) return b;
  if (surface[a].diameter != surface[b].diameter) return surface[a].diameter < surface[b].diameter ? a : b;
  return min(a, b);
}
