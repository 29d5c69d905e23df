// What force kernels with several stages a step declare alike. A dispatch runs the stage that the parameter names. With TILE it runs
// all of them: the frame around counts, and placements are read past caches, because other groups write them meanwhile.
#ifdef TILE
uint stage_index;
SHARED_WRITE(3, PlacementsBefore, real4, placed)
SHARED_WRITE(4, Placements, real, placement)
#else
PARAMETER(3, uint, stage_index)
READ(3, PlacementsBefore, real4, placed)  // the slots that are read: readable only, which GPUs cache better
WRITE(4, Placements, real, placement)
#endif
PARAMETER(4, uint, stage_count)
CONSTANTS(8, Tableau, dvec2, tableau, tableau_size)
bool is_last() { return stage_index + 1u == stage_count; }
