// Whether the body is scripted or one of a cluster, so that its flight is a rigid motion. Needs the array `cluster` and the parameter
// `body_count`.
bool moves_as_one(uint b) { return cluster[body_count].moves_as_one != 0u && cluster[cluster[b].first].moves_as_one != 0u; }
