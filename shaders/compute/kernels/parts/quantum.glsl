// The quantum of impulses is a power of two [Ns]: what the heaviest vertex has at the largest expected velocity is 2^46 of them or up to
// twice as many. Vertices without contacts do not count. Floats hold the quantum and its reciprocal, as 1e-20 Ns is the least that counts
// as such an impulse.
float heaviest_vertex() { return uintBitsToFloat(contact_list[0].heaviest); }
float largest_speed() { return max(uintBitsToFloat(contact_list[0].fastest), float(least_speed)); }
float quantum() {
  float most = max(largest_speed() * heaviest_vertex(), 1e-20f);
  return uintBitsToFloat((floatBitsToUint(most) & 0x7f800000u) - (46u << 23u));
}

// That of energy [J]. All contacts together have fewer than 2^63 of them.
double quantum_of_energy() { return double(64) * double(quantum()) * double(largest_speed()); }
