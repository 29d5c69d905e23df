// What kernels that find contacts share: the list of contacts, and how one is added.
WRITE(contact_list)
WRITE(contact_vertex)
WRITE_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
WRITE(contact_weight)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, keeps_impulses)  // 1: take_up_impulses runs

// Lists a contact of up to four vertices. `least` is the change of velocity that it asks for along the normal, and `goal` the one that
// friction aims at across it [m/s]. A contact that `resumes` begins with its impulse of the last step.
void list_contact(uvec4 who, real4 weight, IN(real3) normal, real least, IN(real3) goal, real friction, real settled,
                  bool resumes) {
  uint at = atomicAdd(contact_list[0].contact_count, 1u);
  if (at >= contact_capacity) return;
  contact_vertex[at] = who;
  contact_row[contact_rows * at] = real4(normal, least);
  contact_row[contact_rows * at + 1u] = weight;
  contact_row[contact_rows * at + 2u] = real4(goal, friction);
  contact_row[contact_rows * at + 3u] = real4(0, 0, 0, settled);
  impulse_row[at] = real4(resumes && keeps_impulses != 0u ? 1 : 0, 0, 0, 0);
  for (int k = 0; k < 4; ++k)
    if (who[k] != no_vertex) atomicAdd(contact_weight[who[k]], uint(float(abs(weight[k])) / weight_unit() + 1.0f));
}
