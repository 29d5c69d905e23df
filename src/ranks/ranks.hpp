// Processes that simulate one scene together, each on a device of its own. All hold the same bodies, and make the same calls in
// the same order. They differ in whose springs they sum.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pliant {

/// Consecutive numbers of an array that all hold.
struct NumberRange {
  std::size_t first = 0, count = 0;
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  [[nodiscard]] virtual std::size_t number() const = 0;  // of this one, from 0
  [[nodiscard]] virtual std::size_t count() const = 0;
  [[nodiscard]] virtual std::size_t number_here() const = 0;  // of this one among those on its machine
  [[nodiscard]] virtual std::size_t count_here() const = 0;

  /// Gives all ranks what rank 0 holds. Waits for it.
  virtual void take_from_first(std::span<std::byte> bytes) = 0;
  /// Returns what each rank says. Waits for all.
  [[nodiscard]] virtual std::vector<std::uint64_t> hear_all(std::uint64_t mine) = 0;

  /// Begins to send this rank's range of an array to all others, and to take theirs. `ranges` has one for each rank. The array
  /// must stay until end_sharing(), and what is sent must not change.
  virtual void begin_sharing(std::span<double> all, std::span<const NumberRange> ranges) = 0;
  /// Lets numbers travel that are on their way.
  virtual void go_on() = 0;
  /// Waits until the sharing that was begun first has ended.
  virtual void end_sharing() = 0;

  /// Is called when all ranks have agreed to end because of a failure. A rank that fails otherwise leaves others waiting.
  virtual void agree_to_end() = 0;
};

/// Returns the first rank that says something else than rank 0, if there is one. Waits for all.
[[nodiscard]] inline std::optional<std::size_t> first_to_differ(Ranks& ranks, std::uint64_t mine) {
  const std::vector<std::uint64_t> all = ranks.hear_all(mine);
  const auto found = std::ranges::find_if(all, [&](std::uint64_t other) { return other != all.front(); });
  return found == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - all.begin()));
}

}  // namespace pliant
