// Whether lists were too short for the pairs or contacts of this step. What they hold then depends on threads, so no result uses it.
// Needs the arrays `contact_list` and `control`.
bool lists_are_full() {
  return contact_list[0].triangle_pair_count > triangle_pair_capacity || contact_list[0].contact_count > contact_capacity ||
         control[0].count[body_pairs_lost] != 0u;
}
