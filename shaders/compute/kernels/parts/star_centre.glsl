// The place from which a body's surface is looked at: the middle of the box of its places at the step's start. Needs the arrays `place_box`
// and `pose`, and the parameter `largest_body`.
dvec3 star_centre(uint b) {
  Box places = box_of_bits(place_box[b]);
  return double(0.5) * (dvec3(places.lower) + dvec3(places.upper));
}

// How far positions of the body in the world may be off by rounding [m].
real rounding_of_places(uint b, dvec3 centre) {
  double far = rounded_from(sum_of_sizes(centre), sum_of_sizes(LOAD3(pose[b].origin, 0u)), largest_body);
  return real(margin_of_rounding(double(0), double(0), far));
}
