// A grid of levels finds boxes that overlap without comparing each with each. Cells of a level are twice as wide as those of the level
// before. A box stands on the first level whose cells are at least as wide as the box, in the cell of its centre. So all boxes as small as
// it that overlap it stand in the 27 cells around, and so do larger ones on their own levels. Cells share a table of lists.
// Source: Ericson, Real-Time Collision Detection (2005), 7.2.
#ifndef GRID_GLSL
#define GRID_GLSL
#include "box.glsl"
SHARED_BEGIN
#ifdef __cplusplus
using glm::floor;
#endif

// A body in the grid.
struct GridEntry {
  float lower[3];  // its box [m]
  float upper[3];
  uint level;
  uint next;  // in the list: the body's number + 1, or 0 at the end
};

// Cells of a level are 2^(level - finest_width) m wide. All boxes of the last level share one cell, whatever their size.
const int finest_width = 96;
const uint last_level = 192u;
const uint no_level = last_level + 1u;  // of a body that is not in the grid
const uint level_words = 7u;  // for a bit a level

FN Box box_of(IN(GridEntry) e) {
  Box box;
  box.lower = vec3(e.lower[0], e.lower[1], e.lower[2]);
  box.upper = vec3(e.upper[0], e.upper[1], e.upper[2]);
  return box;
}

// Widths are taken larger by what rounding may do to centres.
FN uint level_of(IN(Box) box) {
  vec3 size = (box.upper - box.lower) + max(abs(box.lower), abs(box.upper)) * 4.8e-7f;
  float largest = max(size.x, max(size.y, size.z));
  int exponent = int(floatBitsToUint(largest) >> 23u) - 127;
  int level = exponent + 1 + finest_width;
  return uint(level < 0 ? 0 : (level > int(last_level) ? int(last_level) : level));
}

FN ivec3 cell_of(IN(Box) box, uint level) {
  if (level == last_level) return ivec3(0);
  float cells_per_metre = uintBitsToFloat(uint(127 + finest_width - int(level)) << 23u);
  vec3 place = floor((0.5f * box.lower + 0.5f * box.upper) * cells_per_metre);
  return ivec3(int(place.x), int(place.y), int(place.z));
}

// Which list of a table a cell has. The number of lists is a power of two.
FN uint list_of(ivec3 cell, uint level, uint lists) {
  uint hash = uint(cell.x) * 0x8da6b343u + uint(cell.y) * 0xd8163841u + uint(cell.z) * 0xcb1ab31fu + level * 0x165667b1u;
  hash ^= hash >> 15u;
  hash *= 0x2c1b3c6du;
  hash ^= hash >> 13u;
  return hash & (lists - 1u);
}

SHARED_END
#endif
