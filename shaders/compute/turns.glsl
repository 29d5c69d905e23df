// Which item comes at which turn. A GPU promises no order, so nothing may depend on it. Tests have items come from the last to the first.
uint item_at(uint turn, uint count) { return DESCENDS ? count - 1u - turn : turn; }
