// tools/check_layers.py must find this include.
#include "mesh/above.hpp"
