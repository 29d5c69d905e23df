// Adds up moments that the threads of a group have summed, in a fixed order.
NEAR(double, of_threads, moments_numbers * group_size)

// Sets moments to numbers of an array from a place on.
#define LOAD_MOMENTS(m, array, at)             \
  STORE3(m.place, 0u, LOAD3(array, at))         \
  STORE3(m.velocity, 0u, LOAD3(array, at + 3u)) \
  STORE3(m.turning, 0u, LOAD3(array, at + 6u))  \
  STORE3(m.spread, 0u, LOAD3(array, at + 9u))   \
  STORE3(m.spread, 3u, LOAD3(array, at + 12u))

void keep_moments(IN(Moments) m) {
  uint at = moments_numbers * THREAD;
  STORE3(of_threads, at, LOAD3(m.place, 0u))
  STORE3(of_threads, at + 3u, LOAD3(m.velocity, 0u))
  STORE3(of_threads, at + 6u, LOAD3(m.turning, 0u))
  STORE3(of_threads, at + 9u, LOAD3(m.spread, 0u))
  STORE3(of_threads, at + 12u, LOAD3(m.spread, 3u))
}

// Returns the sum of number k, after all threads have kept theirs.
double sum_over_threads(uint k) {
  double sum = double(0);
  for (uint thread = 0u; thread < THREADS; ++thread) sum += of_threads[moments_numbers * thread + k];
  return sum;
}
