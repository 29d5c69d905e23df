// Whether the springs of a clustered body have to be summed, for a stage or where kept forces are stale. Those of a body that is not
// deformed are zero, and nobody reads its sums.
PARAMETER(uint, only_stale)
PARAMETER(uint, skips)

bool sums_clusters(uint b) {
  bool is_deformed = status[b].deformed != 0u || (skips & skips_forces) == 0u;
  bool is_due = only_stale == 0u || status[b].force_stale != 0u;
  return status[b].activity == moving && !is_still(status[b]) && is_deformed && is_due;
}
