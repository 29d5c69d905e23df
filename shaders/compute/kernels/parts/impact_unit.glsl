// An impact's impulses are counted in 1/1024 of what a vertex of the lighter body has at `least_speed` [Ns]. One that can't move counts for
// nothing here, and so do the grounds.
double inverse_vertex_mass(uint b) { return b < body_count ? surface[b].inverse_mass : double(0); }
double impact_unit(uint a, uint b) { return least_speed / (double(1024) * max(inverse_vertex_mass(a), inverse_vertex_mass(b))); }
