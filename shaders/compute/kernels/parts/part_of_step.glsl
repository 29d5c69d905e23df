// The step's length over that which times are for. It is a power of two, so products with it are exact.
double part_of(double time_step) { return parts_of == double(0) ? double(1) : time_step / parts_of; }
#ifdef QUIET
shared double part_at_hand;
double part_of_step() { return part_at_hand; }
#else
double part_of_step() { return part_of(control[0].time_step); }
#endif
