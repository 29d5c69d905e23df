#include "core/memory.hpp"

#include <catch2/catch.hpp>

namespace pliant {

#ifndef __SANITIZE_ADDRESS__  // it ends the program
#ifndef __SANITIZE_THREAD__
TEST_CASE("a little memory is given, and more than addresses reach is not") {
  CHECK(is_memory_given(1'000'000));
  CHECK_FALSE(is_memory_given(std::uint64_t{1} << 60));
  CHECK_FALSE(is_memory_given(~std::uint64_t{0}));
}
#endif
#endif

}  // namespace pliant
