// Which item comes at which turn. A GPU promises no order, so nothing may depend on it. Tests have the device define DESCENDS: items come
// from the last to the first then, and so do the threads of a group.
uint item_at(uint turn, uint count) {
#ifdef DESCENDS
  return count - 1u - turn;
#else
  return turn;
#endif
}
