#include "run/together.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/checksum.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "run/interrupts.hpp"

namespace pliant {
namespace {

enum class Deed : std::uint64_t { advance, advance_toward, compare, end };

// What rank 0 has all others do.
struct Order {
  Deed deed;
  std::uint64_t steps = 0;
  double time = 0;
};

template <class T>
T of_first(Ranks& ranks, T value) {
  ranks.take_from_first(std::as_writable_bytes(std::span(&value, 1)));
  return value;
}

std::uint64_t checksum_of(const State& state) { return checksum(std::as_bytes(std::span(state.motion))); }

void expect_agreement(Ranks& ranks, std::uint64_t mine, const char* problem, const char* remedy) {
  const std::optional<std::size_t> other = first_to_differ(ranks, mine);
  if (!other) return;
  ranks.agree_to_end();
  if (ranks.number() != 0) throw FailedElsewhere();
  throw Error(ErrorKind::device, fmt::format("rank {}", *other), problem, remedy);
}

void compare_bits(Ranks& ranks, const State& state) {
  expect_agreement(ranks, checksum_of(state), "its numbers are no longer those of rank 0",
                   "check the memory of its machine and of its device; then go on from a checkpoint");
}

}  // namespace

void do_together(Ranks* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) return work();
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  const std::vector<std::uint64_t> have_failed = ranks->hear_all(failure != nullptr ? 1 : 0);
  const auto first = std::ranges::find(have_failed, 1u);
  if (first == have_failed.end()) return;
  ranks->agree_to_end();
  if (static_cast<std::size_t>(first - have_failed.begin()) == ranks->number()) std::rethrow_exception(failure);
  throw FailedElsewhere();
}

std::string text_of_first(Ranks& ranks, std::string text) {
  text.resize(of_first(ranks, std::uint64_t{text.size()}));
  ranks.take_from_first(std::as_writable_bytes(std::span(text)));
  return text;
}

void expect_same_options(Ranks& ranks, const RunOptions& options) {
  expect_agreement(ranks, checksum(full_version()), "runs another version of pliant", "use the same on all machines");
  const auto told = [](const auto& number) { return number ? fmt::format("{}", *number) : "-"; };
  const std::string text =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", told(options.steps), told(options.duration), told(options.time_step),
                  told(options.tolerance), options.integrator.value_or("-"), fmt::join(options.overrides, " "),
                  told(options.device.precision), options.device.wish ? static_cast<int>(*options.device.wish) : -1,
                  options.check, !options.resume.empty());
  const auto skipping = checksum(std::as_bytes(std::span(&options.skipping, 1)), checksum(text));
  expect_agreement(ranks, skipping, "has other options", "give all ranks the same");
}

void expect_same_runs(Ranks& ranks, const PreparedRun& run) {
  const auto scene = checksum(std::as_bytes(std::span(run.mesh_checksums)), checksum(run.scene_text));
  expect_agreement(ranks, scene, "has another scene or another mesh", "copy the same files to all machines");
  const std::string plan = fmt::format("{} {} {} {} {}", run.plan.integrator->name, run.plan.time_step, run.plan.steps,
                                       run.plan.tolerance.value_or(0), run.plan.duration);
  expect_agreement(ranks, checksum(plan), "plans other steps", "use machines of one kind");
  const std::string device =
      fmt::format("{} at {} bits, {} at once", run.device->info().name, run.device->precision(), run.device->shares_at_once());
  expect_agreement(ranks, checksum(device), "has another device, whose bits would differ", "use devices of one kind");
}

void Leader::advance(std::uint64_t steps, const std::function<bool()>& stops) {
  if (ranks_ == nullptr) return simulation_.advance(steps, stops);
  of_first(*ranks_, Order{.deed = Deed::advance, .steps = steps});
  simulation_.advance(steps, [&] { return of_first(*ranks_, stops()); });
}

StepReport Leader::advance_toward(double time) {
  if (ranks_ != nullptr) of_first(*ranks_, Order{.deed = Deed::advance_toward, .time = time});
  return simulation_.advance_toward(time);
}

void Leader::compare(const State& state) {
  if (ranks_ == nullptr) return;
  of_first(*ranks_, Order{.deed = Deed::compare});
  compare_bits(*ranks_, state);
}

void Leader::end() {
  if (ranks_ != nullptr) of_first(*ranks_, Order{.deed = Deed::end});
}

void follow(Simulation& simulation, Ranks& ranks) {
  leave_interrupts_to_others();
  for (;;) {
    const Order order = of_first(ranks, Order{});
    switch (order.deed) {
      case Deed::advance:
        simulation.advance(order.steps, [&] { return of_first(ranks, false); });
        break;
      case Deed::advance_toward:
        static_cast<void>(simulation.advance_toward(order.time));
        break;
      case Deed::compare:
        compare_bits(ranks, simulation.state());
        break;
      case Deed::end:
        return;
    }
  }
}

}  // namespace pliant
