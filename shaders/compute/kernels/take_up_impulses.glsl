// One thread gives a contact at rest the impulse that it had in the last step. All threads share the list of contacts in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/contact/contact.glsl"
#include "../physics/contact/parts.glsl"
READ(control)
READ(contact_list)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
WRITE_AS(contact_impulse, real4, impulse_row)
READ(kept_slot)
READ(kept_vertex)
READ_AS(kept_impulse, real4, kept_row)
PARAMETER(uint, contact_capacity)
PARAMETER(uint, contacts_at_once)
#include "parts/kept_slots.glsl"

// The last impulse of the contact, scaled to this step's length, or nothing [Ns].
real4 kept_impulse_of(uvec4 key) {
  real growth = real(growth_of_kick(contact_list[0].last_part, control[0].time_step));
  for (uint slot = first_slot_of(key); is_of_this_step(kept_slot[slot]); slot = slot_after(slot)) {
    uint c = index_of(kept_slot[slot]);
    if (c < contact_list[0].latest_count && kept_vertex[c] == key) return growth * kept_row[c];
  }
  return real4(0);
}

void take_up_impulses(uint item) {
  uint count = min(contact_list[0].contact_count, contact_capacity);
  for (uint c = item; c < count; c += contacts_at_once)
    if (impulse_row[c].x != real(0)) impulse_row[c] = kept_impulse_of(key_of(contact_vertex[c], contact_row[contact_rows * c + 1u]));
}
