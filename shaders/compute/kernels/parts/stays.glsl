// Which motions a step does not make. Needs the arrays `contact_list` and `cut`.

// If lists were too short, or proofs are missing, all bodies keep their places. Those that are near none could move, but this is rare.
bool all_stay() { return contact_list[0].uncertified != 0u || lists_are_full(); }

// Whether proofs stopped the body's flight.
bool flight_was_stopped(uint b) { return has_flight(b) && cut[flight_stop_of(vertex_count, flight_of(b))] != at_no_cut; }

// Bodies that move as one keep their places if that motion was stopped.
bool stays(uint b) { return all_stay() || (moves_as_one(b) && flight_was_stopped(b)); }
