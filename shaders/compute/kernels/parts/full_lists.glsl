// Whether lists were too short for the pairs or contacts of this step. What they hold then depends on threads, so no result uses it.
bool lists_are_full() {
  return contact_list[0].triangle_pair_count > triangle_pair_capacity || contact_list[0].contact_count > contact_capacity;
}
