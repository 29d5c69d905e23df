#define REAL_BITS 64
#include "separation_cases.inc"
