// Which bodies keep their places in a step. Needs the arrays `contact_list` and `cut`.

// If lists were too short, or proofs are missing, all do. Those that are near none could move, but this is rare.
bool all_stay() { return contact_list[0].uncertified != 0u || lists_are_full(); }

// Those of a cluster do, too, if proofs stopped it.
bool stays(uint b) { return all_stay() || (has_common_way(b) && cut[cluster_stop_of(vertex_count, cluster[b].first)] != at_no_cut); }
