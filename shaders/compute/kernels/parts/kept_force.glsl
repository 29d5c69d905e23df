// Where the spring force of vertex i stands in `kept_force`. It needs two halves only where quiet steps may be taken back.
PARAMETER(uint, force_half_size)  // vertices in a half. 0: one serves as both
uint kept_force_of(uint half_index, uint i) { return force_of(in_half(half_index, force_half_size, i)); }
