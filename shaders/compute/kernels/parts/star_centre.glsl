// The place from which a body's surface is looked at: the middle of the box of its places at the step's start. Needs the array `place_box`.
dvec3 star_centre(uint b) {
  Box places = box_of_bits(place_box[b]);
  return double(0.5) * (dvec3(places.lower) + dvec3(places.upper));
}
