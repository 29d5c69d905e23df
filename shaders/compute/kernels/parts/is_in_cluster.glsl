// Whether the body is one of a cluster. Needs the array `cluster` and the parameter `body_count`.
bool is_in_cluster(uint b) { return cluster[body_count].bodies != 0u && cluster[cluster[b].first].bodies != 0u; }
