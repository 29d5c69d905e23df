// What force kernels with several stages a step declare alike. A dispatch is one stage; with TILE all of them, which the frame around
// then counts, and what one group places the others read past their caches.
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
