// Contracts: a broken one is a bug in the caller, so it ends the program.
#pragma once
#include <cstdio>
#include <cstdlib>

#define PLIANT_EXPECT(condition)                                                    \
  do {                                                                              \
    if (!(condition)) {                                                             \
      std::fprintf(stderr, "%s:%d: expected %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                 \
    }                                                                               \
  } while (false)
