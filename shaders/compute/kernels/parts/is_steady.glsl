// Whether a body may go through quiet steps, as far as its status says.
PARAMETER(uint, keeps_force)  // 1: the method keeps spring forces for the next step
bool is_steady(IN(Status) s) {
  if (s.activity == immovable) return s.calm >= at_rest;  // so that it counts as left alone
  if (s.activity != moving || s.disturbed != 0u || s.falls_asleep != 0u) return false;
  return is_idle(s) || (s.calm == 0u && s.asleep == 0u && (keeps_force == 0u || s.force_stale == 0u));
}
