// Compares bits, because shader compilers turn comparisons of floats round as if there were no NaN.
bool is_finite(float number) { return (floatBitsToUint(number) & 0x7fffffffu) <= floatBitsToUint(3.0e38f); }
