#include "core/json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "support/json.hpp"

namespace pliant {
namespace {

TEST_CASE("an object keeps the order of its members, however deep") {
  Json json = {{"z", 1}, {"a", {{"second", true}, {"first", nullptr}}}};
  json.add("m", Json::array({1, "two", Json::object(), Json::array({})}));
  CHECK(json.text() == R"({"z":1,"a":{"second":true,"first":null},"m":[1,"two",{},[]]})");
}

TEST_CASE("indented text has a line a value") {
  const Json json = {{"numbers", std::vector<int>{1, 2}}, {"empty", Json::object()}};
  CHECK(json.text(2) == "{\n  \"numbers\": [\n    1,\n    2\n  ],\n  \"empty\": {}\n}");
}

TEST_CASE("whole numbers are written whole, up to the largest of either sign") {
  CHECK(Json(std::numeric_limits<std::uint64_t>::max()).text() == "18446744073709551615");
  CHECK(Json(std::numeric_limits<std::int64_t>::min()).text() == "-9223372036854775808");
  CHECK(Json(std::uint8_t{200}).text() == "200");
}

TEST_CASE("what is not there and what is not finite are null") {
  CHECK(Json().text() == "null");
  CHECK(Json(std::optional<double>()).text() == "null");
  CHECK(Json(std::optional<double>(0.5)).text() == "0.5");
  for (const double number : {std::nan(""), HUGE_VAL, -HUGE_VAL}) CHECK(Json(number).text() == "null");
}

TEST_CASE("doubles read back to the bit") {
  std::mt19937_64 random(7);
  for (int count = 0; count < 10000; ++count) {
    const std::uint64_t bits = random();
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    if (!std::isfinite(number)) continue;
    CHECK(test::ReadJson::parse(Json(number).text()).get<double>() == number);
  }
}

TEST_CASE("text is escaped, and what is no UTF-8 is replaced") {
  const std::string text = "a \"quoted\" \\ \n \x01 \xC3\xA4";
  CHECK(test::ReadJson::parse(Json(text).text()).get<std::string>() == text);
  CHECK(test::ReadJson::parse(Json("bad \xFF byte").text()).get<std::string>() == "bad \xEF\xBF\xBD byte");
}

}  // namespace
}  // namespace pliant
