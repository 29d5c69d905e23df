// What force kernels with several stages a step declare alike. A dispatch runs the stage that the parameter names. With TILE it runs
// all of them, and the frame around counts. Placements are then read past caches, because other groups write them meanwhile.
#ifdef TILE
uint stage_index;
SHARED_WRITE_AS(placement, real4, placed)
SHARED_WRITE(placement)
WRITE(meeting)
#else
PARAMETER(uint, stage_index)
READ_AS(placement, real4, placed)  // for reading only, which GPUs cache better
WRITE(placement)
#endif
PARAMETER(uint, stage_count)
PARAMETER(uint, adds_force)  // 1: there are forces beside the springs
CONSTANTS(tableau, tableau_size)
bool is_last() { return stage_index + 1u == stage_count; }
