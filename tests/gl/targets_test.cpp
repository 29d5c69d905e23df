// What pictures are drawn into.
#include "gl/targets.hpp"

#include <catch2/catch.hpp>

#include "gl/context.hpp"
#include "support/expect_error.hpp"
#include "support/has.hpp"

using namespace pliant;
using namespace pliant::gl;

TEST_CASE("a texture beyond the driver's largest size is an error that says what to lower, and not a bug", "[gl]") {
  if (test::lacks_gl()) return;
  const Context context(0);
  constexpr std::uint32_t rgba8 = 0x8058, beyond = 1u << 20;
  for (const int samples : {1, 4}) {
    for (const glm::uvec2& size : {glm::uvec2(beyond, 1), glm::uvec2(1, beyond)}) {
      const Error error = error_of([&] {
        const Texture texture({.format = rgba8, .size = size, .samples = samples}, "wide");
        return 0;
      });
      CHECK(error.kind() == ErrorKind::device);
      check_says(error, {"\"wide\"", "1048576", "the driver allows", "output.size"});
    }
  }
  const Texture texture({.format = rgba8, .size = {16, 16}, .samples = 4}, "small");  // afterwards all is as before
  CHECK_NOTHROW(Framebuffer(&texture, nullptr, "small"));
}
