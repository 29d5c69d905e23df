// What steps leave out, because it is known to change nothing.
#pragma once
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace pliant {

/// Which kinds of work steps leave out.
struct Skipping {
  bool forces = true;  // of bodies that are not deformed
  bool rest = true;    // all that is done for bodies at rest
  // The search for contacts, and dispatches, where no contact can need an answer. No step is quiet in which one of the others is
  // done.
  bool quiet_steps = true;

  bool operator==(const Skipping&) const = default;
};

/// A kind of work, by the name that the command line has for it.
struct SkippingKind {
  std::string_view name;
  bool Skipping::*is_skipped;
};
inline constexpr SkippingKind skipping_kinds[] = {
    {"forces", &Skipping::forces}, {"rest", &Skipping::rest}, {"quiet_steps", &Skipping::quiet_steps}};
static_assert(sizeof(Skipping) == std::size(skipping_kinds) * sizeof(bool), "each kind of work is in the list");
inline constexpr std::string_view all_skipping_kinds = "all";  // which stands for each of them

inline constexpr Skipping skip_nothing = [] {
  Skipping nothing;
  for (const SkippingKind& kind : skipping_kinds) nothing.*kind.is_skipped = false;
  return nothing;
}();

/// Returns what steps leave out that do the work of these kinds. Names of no kind change nothing.
[[nodiscard]] constexpr Skipping skipping_without(std::span<const std::string> names) {
  Skipping skipping;
  for (const std::string& name : names)
    for (const SkippingKind& kind : skipping_kinds)
      if (name == kind.name || name == all_skipping_kinds) skipping.*kind.is_skipped = false;
  return skipping;
}

}  // namespace pliant
