// Whether the springs of a leaf have to be summed. Leaves of a tile may be none.
#include "sums_clusters.glsl"
PARAMETER(uint, first_leaf)
PARAMETER(uint, end_leaf)  // of those that are served

bool sums_leaf(uint leaf) { return leaf < end_leaf && sums_clusters(spring_leaf[leaf].x); }
