// The list of responses.
#include "collision/responses/response.hpp"

#include <catch2/catch.hpp>

#include "support/expect_error.hpp"

namespace pliant {
namespace {

TEST_CASE("a response that there is not is an error that lists those there are") {
  const Error error = error_of([] { return find_response({"bounce", "scene.toml:2: collision.response"}); });
  CHECK(error.kind() == ErrorKind::input);
  check_says(error, {"scene.toml:2: collision.response", "bounce", "none, reflect"});
}

TEST_CASE("none is no response, and every row is found by its name") {
  CHECK(find_response({"none"}) == nullptr);
  for (const ResponseRow& row : responses()) CHECK(find_response({std::string(row.name)}) == &row);
}

}  // namespace
}  // namespace pliant
