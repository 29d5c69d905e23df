// Finds contacts of the last step again, whatever order they stand in. A contact's place among the slots follows from its vertices, or is
// the next one that is free. Entries of other steps count as free. Numbers of steps come back after a while, so an entry has to be compared
// with the contact that it names.
PARAMETER(uint, kept_slot_count)  // a power of two

// No entry is 0, which means that nobody has written there.
uint stamp() { return 1u + control[0].step % ((1u << (32u - kept_index_bits)) - 1u); }

bool is_of_this_step(uint entry) { return entry >> kept_index_bits == stamp(); }
uint index_of(uint entry) { return entry & ((1u << kept_index_bits) - 1u); }

const uint of_two_edges = 0x80000000u;

// Contacts of a vertex with several grounds differ in the last number. physics/contact/contact.glsl says where it stands. In a body that
// meets itself two edges may have the same vertices, in the same order, as a vertex and a triangle. A bit that no vertex has tells them
// apart.
uvec4 key_of(uvec4 who, real4 weight) {
  if (who.y == no_vertex) return uvec4(who.x, who.y, who.z, uint(weight.w));
  bool are_edges = weight.x > real(0) && weight.y > real(0);
  return uvec4(are_edges ? who.x | of_two_edges : who.x, who.y, who.z, who.w);
}

uint first_slot_of(uvec4 key) {
  uint mixed = key.x * 73856093u ^ key.y * 19349663u ^ key.z * 83492791u ^ key.w * 2654435761u;
  mixed = (mixed ^ mixed >> 15u) * 2246822519u;
  return (mixed ^ mixed >> 13u) & (kept_slot_count - 1u);
}
uint slot_after(uint slot) { return (slot + 1u) & (kept_slot_count - 1u); }
