// The quantum of impulses is a power of two [Ns]: what the heaviest vertex has at the largest expected
// velocity is 2^46 of them or up to twice as many.
float largest_speed() { return max(uintBitsToFloat(contact_list[0].fastest), float(least_speed)); }
double quantum() {
  float most = largest_speed() * float(heaviest_vertex);
  return double(uintBitsToFloat(floatBitsToUint(most) & 0x7f800000u)) / double(70368744177664.0);
}

// That of energy [J]. All contacts together have fewer than 2^63 of them.
double quantum_of_energy() { return double(64) * quantum() * double(largest_speed()); }
