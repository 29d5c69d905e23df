#include "run/together.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "run/choose_device.hpp"
#include "support/clustered_bodies.hpp"
#include "support/evolve.hpp"
#include "support/thread_ranks.hpp"

namespace pliant {
namespace {

using test::on_ranks;

// What do_together, or something else that ranks do together, has thrown on a rank, if they have agreed to end.
enum class Thrown { nothing, own, elsewhere };

std::vector<Thrown> thrown_on(std::size_t count, const std::function<void(Ranks&)>& work) {
  std::vector<Thrown> thrown(count, Thrown::nothing);
  on_ranks(count, [&](test::ThreadRanks& ranks) {
    Thrown& mine = thrown[ranks.number()];
    try {
      work(ranks);
    } catch (const FailedElsewhere&) {
      mine = Thrown::elsewhere;
    } catch (const Error& error) {
      mine = Thrown::own;
    }
    if (ranks.have_agreed_to_end() != (mine != Thrown::nothing)) throw std::logic_error("ranks end without each other");
  });
  return thrown;
}

std::vector<Thrown> thrown_where(const std::vector<bool>& fails) {
  return thrown_on(fails.size(), [&](Ranks& ranks) {
    do_together(&ranks, [&] {
      if (fails[ranks.number()]) throw Error(ErrorKind::input, "", "wrong", "");
    });
  });
}

TEST_CASE("what goes wrong on some ranks is told by the first of them, and ends all") {
  using enum Thrown;
  CHECK(thrown_where({false, false, false}) == std::vector{nothing, nothing, nothing});
  CHECK(thrown_where({false, true, true}) == std::vector{elsewhere, own, elsewhere});
  CHECK(thrown_where({true, true, true}) == std::vector{own, elsewhere, elsewhere});
}

TEST_CASE("ranks whose options differ end, and the first tells") {
  using enum Thrown;
  const auto with = [](const std::function<void(RunOptions&)>& change) {
    return thrown_on(2, [&](Ranks& ranks) {
      RunOptions options;
      if (ranks.number() == 1) change(options);
      expect_same_options(ranks, options);
    });
  };
  CHECK(with([](RunOptions&) {}) == std::vector{nothing, nothing});
  CHECK(with([](RunOptions& options) { options.quiet = true; }) == std::vector{nothing, nothing});
  const std::vector<std::function<void(RunOptions&)>> changes = {
      [](RunOptions& options) { options.check = true; },
      [](RunOptions& options) { options.resume = "a checkpoint"; },
      [](RunOptions& options) { options.overrides = {"body.left.stiffness=9"}; },
      [](RunOptions& options) { options.duration = 2; },
      [](RunOptions& options) { options.device.precision = 64; },
      [](RunOptions& options) { options.skipping.rest = false; }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    CAPTURE(k);
    CHECK(with(changes[k]) == std::vector{own, elsewhere});
  }
}

// Rank 0 leads. The bits of the second are its own if `goes_astray`.
std::vector<Thrown> thrown_by_run(bool goes_astray) {
  const ModelAndState start = deformed_sphere(1, "dent");
  return thrown_on(2, [&](Ranks& ranks) {
    const auto device = make_cpu_device(1, 32);
    device->join(&ranks);
    Simulation run(*device, start.model, start.state, plan_of({"verlet", 0.001}), no_contacts);
    if (ranks.number() == 1 && goes_astray) run.pull({.vertex = 0, .target = {5, 0, 0}}, 0.01);
    if (ranks.number() == 1) return follow(run, ranks);
    Leader leader(run, &ranks);
    leader.advance(40, [] { return false; });
    leader.compare(run.state());
    leader.advance(1000, [asked = 0]() mutable { return ++asked == 2; });  // an early end
    CHECK(run.report().steps < 1040);
    leader.compare(run.state());
    leader.end();
  });
}

TEST_CASE("ranks make the steps that the first makes, and end when one has other bits") {
  using enum Thrown;
  CHECK(thrown_by_run(false) == std::vector{nothing, nothing});
  CHECK(thrown_by_run(true) == std::vector{own, elsewhere});
}

TEST_CASE("ranks share the processors of a machine, if MPI has not done so") {
  CHECK(threads_of_rank(32, 32, 1) == 32);
  CHECK(threads_of_rank(32, 32, 2) == 16);
  CHECK(threads_of_rank(1, 32, 2) == 1);    // each bound to one
  CHECK(threads_of_rank(16, 32, 2) == 16);  // each to a half
  CHECK(threads_of_rank(16, 32, 4) == 8);   // two to each half
  CHECK(threads_of_rank(2, 2, 5) == 1);
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
