// What can be drawn at all.

/// False for NaN, infinities and what would overflow in a matrix product.
bool is_drawable(vec3 p) { return all(lessThan(abs(p), vec3(1e15))); }
