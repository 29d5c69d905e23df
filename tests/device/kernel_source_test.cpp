// Writes out declarations of kernels that are made up here. This needs no GPU.
#include "device/gpu/kernel_source.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "device/array_list.hpp"
#include "support/expect_error.hpp"

namespace pliant {
namespace {

// A kernel that reads the first `count` arrays of the list.
std::string kernel_reading(std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += "READ(" + std::string(array_list()[k].name) + ")\n";
  return text;
}

gpu::KernelSource source_of(const std::string& kernel) {
  const gl::ShaderFile files[] = {{"compute/main.comp", "#version 450\n#include \"@kernel\"\n"},
                                  {"compute/kernels/greedy.glsl", kernel}};
  const gl::Define defines[] = {{"@kernel", "compute/kernels/greedy.glsl"}};
  return gpu::kernel_source(files, "compute/main.comp", defines);
}

TEST_CASE("a kernel with more arrays than a device binds is an error that names it") {
  CHECK(source_of(kernel_reading(max_arrays)).signature.arrays.size() == max_arrays);
  const Error error = error_of([] { static_cast<void>(source_of(kernel_reading(max_arrays + 1))); });
  CHECK(error.kind() == ErrorKind::device);
  check_says(error, {"compute/kernels/greedy.glsl", "17 arrays", "16"});
}

TEST_CASE("constants are numbered apart from arrays, and do not count among them") {
  const gpu::KernelSource source = source_of("CONSTANTS(tableau, 4)\n" + kernel_reading(max_arrays));
  CHECK(source.signature.arrays.size() == max_arrays + 1);
  CHECK_THAT(source.shader.text, Catch::Contains(fmt::format("std140, binding = {}", max_arrays)));
  for (std::size_t k = 0; k < max_arrays; ++k)
    CHECK_THAT(source.shader.text, Catch::Contains(fmt::format("std430, binding = {})", k)));
  CHECK_THROWS_AS(source_of("CONSTANTS(tableau, 4)\nCONSTANTS(body, 4)\n"), Error);
}

TEST_CASE("a declaration that names no array is an error with file and line") {
  const Error error = error_of([] { static_cast<void>(source_of("READ(body)\nWRITE(no_such_array)\n")); });
  check_says(error, {"compute/kernels/greedy.glsl:2", "no_such_array"});
}

TEST_CASE("an array that a kernel names twice has one slot") {
  const gpu::KernelSource source = source_of("READ(body)\nWRITE(motion)\nREAD(body)\n");
  REQUIRE(source.signature.arrays.size() == 2);
  CHECK((source.signature.arrays[0].array == "body" && source.signature.arrays[1].array == "motion"));
}

}  // namespace
}  // namespace pliant
