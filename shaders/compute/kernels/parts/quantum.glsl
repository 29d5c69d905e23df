// The quantum of impulses is a power of two [Ns]: what the heaviest vertex has at the largest expected
// velocity is 2^46 of them or up to twice as many.
double quantum() {
  float most = max(uintBitsToFloat(contact_list[0].fastest), float(least_speed)) * float(heaviest_vertex);
  return double(uintBitsToFloat(floatBitsToUint(most) & 0x7f800000u)) / double(70368744177664.0);
}
