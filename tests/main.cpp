// The one file that compiles Catch2's own code.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
