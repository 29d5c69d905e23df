// Mesa's llvmpipe silently stops what has gone through loops 65,535 times. Loops then end after one turn, and so does this one. `count` is
// a number above 0 that compilers do not know.
bool was_stopped(uint count) {
  uint turns = 0u, most = 1u + min(count, 3u);
  while (turns < most) ++turns;
  return turns < most;
}
