// Adds to the run's count of one kind. Needs the array `control`.
void add_to_total(uint k, uint count) {
  uint sum = control[0].total_low[k] + count;
  if (sum < count) control[0].total_high[k] += 1u;
  control[0].total_low[k] = sum;
}
