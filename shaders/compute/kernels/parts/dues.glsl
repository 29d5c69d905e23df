// Whether something is to be paid. The last debt is that of all bodies together, and the last cluster counts bodies in clusters. Needs the
// arrays `contact_list`, `debt` and `cluster`.
bool has_dues() {
  return contact_list[0].has_dues != 0u || debt[body_count].energy > double(0) || cluster[body_count].bodies != 0u;
}
