// Makes contacts and their vertices ready for the first round of the kick. One thread serves one contact. It gives a contact at rest the
// impulse that it had in the last step, and empties the sums that this round adds to. All threads share the list of contacts in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/layout.glsl"
#include "../physics/contact/contact.glsl"
#include "../physics/contact/exact_sum.glsl"
#include "../physics/contact/parts.glsl"
READ(control)
READ(contact_list)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
READ(kept_slot)
READ(kept_key)
READ_AS(kept_impulse, real4, kept_row)
WRITE(impulse_sum)
PARAMETER(uint, vertex_count)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, contacts_at_once)
#include "parts/kept_slots.glsl"
#include "parts/impulse_sums.glsl"

// The last impulse of the contact, scaled to this step's length, or nothing [Ns].
real4 kept_impulse_of(uvec4 key) {
  real growth = real(growth_of_kick(contact_list[0].last_part, control[0].time_step));
  uint slot = first_slot_of(key);
  for (uint k = 0u; k < kept_slot_count && is_of_this_step(kept_slot[slot]); ++k, slot = slot_after(slot)) {
    uint c = index_of(kept_slot[slot]);
    if (c < contact_list[0].latest_count && kept_key[c] == key) return growth * kept_row[c];
  }
  return real4(0);
}

void take_up_impulses(uint item) {
  uint count = min(contact_list[0].contact_count, contact_capacity);
  for (uint c = item; c < count; c += contacts_at_once) {
    uvec4 who = contact_vertex[c];
    for (int k = 0; k < 4; ++k)
      if (who[k] != no_vertex) clear_impulse(impulse_sum_of(buffer_of(1u), vertex_count, who[k]));
    if (impulse_row[c].x != real(0)) impulse_row[c] = kept_impulse_of(key_of(who, contact_row[contact_rows * c + 1u]));
  }
}
