// The quantum of impulses is a power of two [Ns]: 2^46 are what the heaviest vertex has at the largest expected velocity, or more.
double quantum() {
  float most = max(uintBitsToFloat(contact_list[0].fastest), float(least_speed)) * float(heaviest_vertex);
  return double(uintBitsToFloat(floatBitsToUint(most) & 0x7f800000u)) / double(70368744177664.0);
}
