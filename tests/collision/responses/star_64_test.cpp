#define REAL_BITS 64
#include "star_cases.inc"
