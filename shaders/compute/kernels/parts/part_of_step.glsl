// The step's length over that which times are for. It is a power of two, so products with it are exact.
double part_of_step() { return parts_of == double(0) ? double(1) : control[0].time_step / parts_of; }
