// What kernels that find contacts share: the list of contacts, and how one is added.
WRITE(contact_list)
WRITE(contact_vertex)
WRITE_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
WRITE(contact_weight)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, keeps_impulses)  // 1: contacts at rest begin with their last impulse

// Contacts give impulses in quanta of what these vertices have. Those of rigid bodies have no mass, but may be scripted and fast.
void count_vertex(uint i) {
  double inverse_mass = surface[uint(rest_position[i].w)].inverse_mass;
  uint speed = floatBitsToUint(float(length(LOAD3(expected, force_of(i)))));
  RAISE_TO(contact_list[0].fastest, speed)
  if (inverse_mass == double(0)) return;
  uint mass = floatBitsToUint(float(double(1) / inverse_mass));
  RAISE_TO(contact_list[0].heaviest, mass)
}

// Lists a contact of up to four vertices. `goal` is the change of velocity that friction aims at across the normal [m/s]. A contact at rest
// begins with its impulse of the last step.
void list_contact(uvec4 who, real4 weight, IN(real3) normal, IN(Course) c, IN(Approach) a, IN(real3) goal, real friction) {
  uint at = atomicAdd(contact_list[0].contact_count, 1u);
  if (at >= contact_capacity) return;
  contact_vertex[at] = who;
  contact_row[contact_rows * at] = real4(normal, least_velocity(c, a) - c.velocity);
  contact_row[contact_rows * at + 1u] = weight;
  contact_row[contact_rows * at + 2u] = real4(goal, friction);
  contact_row[contact_rows * at + 3u] = real4(0, 0, 0, settled_speed(a));
  contact_row[contact_rows * at + 5u] = real4(bounce_of(c, a), 0, 0, 0);
  impulse_row[at] = real4(rests(c) && keeps_impulses != 0u ? 1 : 0, 0, 0, 0);
  for (int k = 0; k < 4; ++k) {
    if (who[k] == no_vertex) continue;
    atomicAdd(contact_weight[who[k]], uint(float(abs(weight[k])) / weight_unit() + 1.0f));
    count_vertex(who[k]);
  }
}
