#include "state/shared_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>

namespace pliant {
namespace {

// Phases of a step, as bits. In each of them some passes run, one after another.
using Phases = std::uint32_t;
constexpr Phases restoring = 1,  // restore_impacts
    searching = 2,               // from expect_motion or a refit to find_contacts, meet_grounds and test_unlisted_pairs
    kicking = 4,                 // take_up_impulses and solve_contacts
    at_stages = 8,               // share_pulls, sum_springs, passes of other forces before a stage, and the stage
    cutting = 16,                // from expect_cuts to pay_dues
    at_quiet_steps = 32,         // from list_moving_shares to end_quiet_steps
    placing_nodes = 64,          // sum_leaf_moments and place_nodes
    pulling_nodes = 128;         // sum_leaf_springs and sum_node_pulls

struct Sharing {
  std::string_view array;
  Phases phases;  // in which it is needed. A phase reaches from where the array is written to where it is last read
};

// In each phase the array is written before it is read, for every body whose numbers are read. So an array can't share memory if
// bodies at rest need what an earlier step wrote there.
constexpr Sharing sharing[] = {
    {"expected", searching},         // expect_motion writes it for all bodies
    {"node_box", searching},         // the passes of a refit write every box that a search reads
    {"treelet_pair", searching},     // the list's length stands in `control`, and nothing beyond it is read
    {"leaf_pair", searching},        // as above
    {"impulse_sum", kicking},        // take_up_impulses empties what the first round adds to. Each round empties for the next
    {"leaf_moment", placing_nodes},  // sum_leaf_moments writes it for all leaves that place_nodes looks at
    {"node_pull", pulling_nodes},    // sum_leaf_springs writes it for all clusters that sum_node_pulls looks at
    {"spring_sum", at_stages},   // share_pulls and exchanges of ranks write it for bodies whose sums are given and not skipped
    {"added_force", at_stages},  // the first force sets it, and others add to it
    {"moment", at_stages},       // sum_moments writes it for all bodies that find_rigid_motion looks at
    {"way", cutting},            // expect_cuts writes it for all bodies that have a partner or move
    {"cut", cutting},            // as above
    {"quiet_body", at_quiet_steps},     // passes before quiet_steps write what it reads first, unless no step may be quiet
    {"kept_before", at_quiet_steps},    // quiet_steps writes it for all bodies that move
    {"part_sum", restoring | cutting},  // the first round of restore_impacts or pay_dues writes it
};

Phases phases_of(std::string_view array) {
  const auto* const found = std::ranges::find(sharing, array, &Sharing::array);
  return found == std::end(sharing) ? 0 : found->phases;
}

}  // namespace

bool shares_memory(std::string_view array) { return phases_of(array) != 0; }

bool may_overlap(std::string_view a, std::string_view b) {
  return shares_memory(a) && shares_memory(b) && (phases_of(a) & phases_of(b)) == 0;
}

void expect_apart(std::span<const KernelSignature::Array> arrays) {
  for (const auto& a : arrays)
    for (const auto& b : arrays)
      if (may_overlap(a.array, b.array))
        throw std::logic_error(fmt::format("the arrays \"{}\" and \"{}\" share memory", a.array, b.array));
}

std::vector<std::string_view> sharing_arrays() {
  std::vector<std::string_view> names;
  for (const Sharing& row : sharing) names.push_back(row.array);
  return names;
}

SharedMemory::~SharedMemory() {
  if (buffer_ != 0) device_.release(buffer_);
}

// Goes through the places that the array must not overlap, in their order, up to the first gap that is large enough.
BufferId SharedMemory::place(std::string_view array, std::size_t bytes) {
  const std::size_t size = (bytes + part_alignment - 1) / part_alignment * part_alignment;
  std::size_t first_byte = 0;
  for (const Place& other : places_) {
    if (other.array == array || may_overlap(array, other.array) || other.end <= first_byte) continue;
    if (first_byte + size <= other.first_byte) break;
    first_byte = other.end;
  }
  const Place place{std::string(array), first_byte, first_byte + size};
  if (buffer_ == 0) buffer_ = device_.allocate(place.end, "shared by phases", Content::anything);
  if (device_.size_of(buffer_) < place.end) device_.enlarge(buffer_, place.end);
  std::erase_if(places_, [&](const Place& earlier) { return earlier.array == array; });
  places_.insert(std::ranges::upper_bound(places_, first_byte, {}, &Place::first_byte), place);
  return device_.part_of(buffer_, first_byte, bytes);
}

}  // namespace pliant
