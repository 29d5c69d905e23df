// How far a box reaches along a normal, at least.
double least_along(dvec3 normal, dvec3 lower, dvec3 upper) {
  dvec3 centre = double(0.5) * (lower + upper), half_size = double(0.5) * (upper - lower);
  return dot(normal, centre) - dot(abs(normal), half_size);
}

// How high a box stands above a ground [m]. Needs the array `ground`.
double height_above(uint g, dvec3 lower, dvec3 upper) {
  return least_along(LOAD3(ground[g].normal, 0u), lower, upper) - ground[g].offset;
}
