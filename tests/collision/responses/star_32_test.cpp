#define REAL_BITS 32
#include "star_cases.inc"
