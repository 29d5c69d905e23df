// One thread keeps the impulse of a contact of the last step, so that the same contact begins with it in this one. All threads share the
// list of contacts in strides.
#include "../physics/body.glsl"
#include "../physics/control.glsl"
#include "../physics/contact/contact.glsl"
READ(control)
READ(contact_list)
READ(contact_vertex)
READ_AS(contact, real4, contact_row)
READ_AS(contact_impulse, real4, impulse_row)
SHARED_WRITE(kept_slot)
WRITE(kept_key)
WRITE_AS(kept_impulse, real4, kept_row)
PARAMETER(uint, contacts_at_once)
#include "parts/kept_slots.glsl"

void note(uvec4 key, uint c) {
  uint entry = stamp() << kept_index_bits | c;
  uint slot = first_slot_of(key);
  for (uint k = 0u; k < kept_slot_count; ++k) {
    uint before = ATOMIC_LOAD(kept_slot[slot]);
    if (is_of_this_step(before))
      slot = slot_after(slot);
    else if (atomicCompSwap(kept_slot[slot], before, entry) == before)
      return;
  }
}

void keep_impulses(uint item) {
  if (control[0].time_step == double(0)) return;
  for (uint c = item; c < contact_list[0].latest_count; c += contacts_at_once) {
    bool gave = impulse_row[c].x > real(0);
    kept_key[c] = gave ? key_of(contact_vertex[c], contact_row[contact_rows * c + 1u]) : uvec4(no_vertex);
    kept_row[c] = impulse_row[c];
    if (gave) note(kept_key[c], c);
  }
}
