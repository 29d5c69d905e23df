#define REAL_BITS 32
#include "separation_cases.inc"
