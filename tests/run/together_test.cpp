#include "run/together.hpp"

#include <catch2/catch.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "support/thread_ranks.hpp"

namespace pliant {
namespace {

using test::on_ranks;

// What do_together has thrown on each rank: a text of its own, or the exit code of another one's failure.
struct Thrown {
  std::optional<std::string> own;
  std::optional<int> elsewhere;
  bool operator==(const Thrown&) const = default;
};

std::vector<Thrown> thrown_where(const std::vector<bool>& fails) {
  std::vector<Thrown> thrown(fails.size());
  on_ranks(fails.size(), [&](Ranks& ranks) {
    Thrown& mine = thrown[ranks.number()];
    try {
      do_together(&ranks, [&] {
        if (fails[ranks.number()]) throw Error(ErrorKind::input, "rank", std::to_string(ranks.number()), "");
      });
    } catch (const FailedElsewhere& failure) {
      mine.elsewhere = failure.exit_code;
    } catch (const Error& error) {
      mine.own = error.problem();
    }
  });
  return thrown;
}

TEST_CASE("what goes wrong on some ranks is told by the first of them, and ends all") {
  CHECK(thrown_where({false, false, false}) == std::vector<Thrown>(3));
  CHECK(thrown_where({false, true, true}) == std::vector<Thrown>{{{}, 3}, {"1", {}}, {{}, 3}});
  CHECK(thrown_where({true, true, true}) == std::vector<Thrown>{{"0", {}}, {{}, 3}, {{}, 3}});
}

TEST_CASE("a rank alone throws what its work throws") {
  CHECK_THROWS_AS(do_together(nullptr, [] { throw std::runtime_error("mine"); }), std::runtime_error);
}

TEST_CASE("all ranks get the text of the first, whatever theirs is") {
  for (const std::string& text : {std::string(), std::string("some text"), std::string(100000, 'x')}) {
    std::vector<std::string> texts(3);
    on_ranks(3, [&](Ranks& ranks) {
      texts[ranks.number()] = text_of_first(ranks, ranks.number() == 0 ? text : std::string("another"));
    });
    CHECK(texts == std::vector(3, text));
  }
}

}  // namespace
}  // namespace pliant
