#include "run/together.hpp"

#include <fmt/format.h>

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

enum class Deed : std::uint32_t { advance, advance_toward, compare, end };

// What rank 0 has all others do.
struct Order {
  Deed deed;
  std::int32_t exit_code = 0;
  std::uint64_t steps = 0;
  double time = 0;
};

template <class T>
T of_first(Ranks& ranks, T value) {
  ranks.take_from_first(std::as_writable_bytes(std::span(&value, 1)));
  return value;
}

constexpr int unexpected = 1;  // exit code of what is not an Error

std::uint64_t checksum_of(const State& state) { return checksum(std::as_bytes(std::span(state.motion))); }

void expect_agreement(Ranks& ranks, std::uint64_t mine, const char* problem, const char* remedy) {
  const std::optional<std::size_t> other = first_to_differ(ranks, mine);
  if (!other) return;
  if (ranks.number() != 0) throw FailedElsewhere{static_cast<int>(ErrorKind::device)};
  throw Error(ErrorKind::device, fmt::format("rank {}", *other), problem, remedy);
}

void compare_bits(Ranks& ranks, const State& state) {
  expect_agreement(ranks, checksum_of(state), "its numbers are no longer those of rank 0",
                   "check the memory of its machine and of its device; then go on from a checkpoint");
}

}  // namespace

void do_together(Ranks* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) return work();
  int code = 0;
  std::exception_ptr failure;
  try {
    work();
  } catch (const Error& error) {
    failure = std::current_exception();
    code = static_cast<int>(error.kind());
  } catch (...) {
    failure = std::current_exception();
    code = unexpected;
  }
  const std::vector<std::uint64_t> codes = ranks->hear_all(static_cast<std::uint64_t>(code));
  const auto first = std::ranges::find_if(codes, [](std::uint64_t each) { return each != 0; });
  if (first == codes.end()) return;
  if (static_cast<std::size_t>(first - codes.begin()) == ranks->number()) std::rethrow_exception(failure);
  throw FailedElsewhere{static_cast<int>(*first)};
}

std::string text_of_first(Ranks& ranks, std::string text) {
  text.resize(of_first(ranks, std::uint64_t{text.size()}));
  ranks.take_from_first(std::as_writable_bytes(std::span(text)));
  return text;
}

void expect_same(Ranks& ranks, const PreparedRun& run) {
  expect_agreement(ranks, checksum(full_version()), "runs another version of pliant", "use the same on all machines");
  const auto scene = checksum(std::as_bytes(std::span(run.mesh_checksums)), checksum(run.scene_text));
  expect_agreement(ranks, scene, "has another scene or another mesh", "copy the same files to all machines");
  const std::string plan =
      fmt::format("{} {} {} {}", run.plan.integrator->name, run.plan.time_step, run.plan.steps, run.plan.tolerance.value_or(0));
  expect_agreement(ranks, checksum(plan), "has other options", "give all ranks the same");
  const std::string device = fmt::format("{} at {} bits", run.device->info().name, run.device->precision());
  expect_agreement(ranks, checksum(device), "has another device, whose bits would differ",
                   "use machines of one kind, or set PLIANT_ISA=avx2 for all");
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

void Leader::end(int exit_code) {
  if (ranks_ != nullptr) of_first(*ranks_, Order{.deed = Deed::end, .exit_code = exit_code});
}

int follow(Simulation& simulation, Ranks& ranks) {
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
        return order.exit_code;
    }
  }
}

}  // namespace pliant
