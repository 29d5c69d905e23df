// Whether the body is at rest and no other is near. Needs the arrays `control` and `status`.
bool is_left_alone(uint b) { return is_idle(status[b]) && status[b].partner_step != control[0].step; }
