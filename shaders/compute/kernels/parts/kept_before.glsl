// The spring forces that were kept when a quiet step began, because it may be taken back.
WRITE(kept_before)
void note_force(uint i, uint k) { kept_before[force_of(i) + k] = kept_force[force_of(i) + k]; }
void take_back_force(uint i, uint k) { kept_force[force_of(i) + k] = kept_before[force_of(i) + k]; }
