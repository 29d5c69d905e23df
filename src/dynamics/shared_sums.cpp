#include "dynamics/shared_sums.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

namespace pliant {
namespace {

// Vertices of a body whose springs one rank sums.
struct Part {
  std::size_t variant;
  std::uint32_t body, first_vertex, vertex_count;  // the first vertex is the model's
  double springs = 0;                              // how much work it is
};
using Parts = std::vector<Part>;

// A device that sums whole bodies sums small ones faster than parts of them.
std::uint32_t part_size(const ForceVariant& variant, std::uint32_t vertex_count, std::size_t ranks) {
  constexpr std::uint32_t smallest = 256;
  if (variant.share_size < vertex_count) return variant.share_size;
  const auto sharers = static_cast<std::uint32_t>(ranks);
  return std::max((vertex_count + sharers - 1) / sharers, smallest);
}

// By variants, and then by bodies.
Parts cut(const DeviceBodies& bodies, const Model& model, const std::vector<bool>& are_clustered, std::size_t ranks) {
  const auto variants = bodies.arrays.device().force_variants();
  Parts parts;
  for (std::size_t v = 0; v < variants.size(); ++v)
    for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
      const ModelBody& body = model.bodies[b];
      if (body.is_rigid() || are_clustered[b] || bodies.force_variants[b] != v) continue;
      const std::uint32_t size = part_size(variants[v], body.vertex_count, ranks);
      for (std::uint32_t first = 0; first < body.vertex_count; first += std::min(size, body.vertex_count - first)) {
        const std::uint32_t count = std::min(size, body.vertex_count - first);
        parts.push_back({v, b, body.first_vertex + first, count, static_cast<double>(count) * body.vertex_count});
      }
    }
  return parts;
}

// Returns each rank's parts. They are about the same work.
std::vector<Parts> share_out(const Parts& parts, std::size_t ranks) {
  double all = 0, before = 0;
  for (const Part& part : parts) all += part.springs;
  std::vector<Parts> of_ranks(ranks);
  std::size_t rank = 0;
  for (const Part& part : parts) {
    while (before + part.springs / 2 > all * static_cast<double>(rank + 1) / static_cast<double>(ranks)) ++rank;
    of_ranks[rank].push_back(part);
    before += part.springs;
  }
  return of_ranks;
}

// Returns how many multiprocessors take parts, or 0 for a device that sums whole bodies at once.
std::size_t multiprocessors_of(const Device& device) {
  return device.info().kind == DeviceKind::cpu ? 0 : std::max(device.shares_at_once(), 1u);
}

// Returns a rank's parts in portions: half of them, the rest, and few at the end, because nothing hides the last one's way. A
// multiprocessor takes one, two or three groups at once, so portions of whole turns of six for each keep all busy to the end.
std::vector<Parts> in_portions(const Parts& parts, std::size_t multiprocessors) {
  const std::size_t turn = 6 * multiprocessors, turns = turn == 0 || parts.empty() ? 0 : (parts.size() - 1) / turn;
  std::vector<Parts> portions;
  std::size_t begin = 0;
  for (const std::size_t end : {(turns + 1) / 2 * turn, turns * turn, parts.size()}) {
    if (end > begin)
      portions.emplace_back(parts.begin() + static_cast<std::ptrdiff_t>(begin), parts.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return portions;
}

// Where the sums of the parts stand in `spring_sum`.
std::vector<NumberRange> numbers_of(const Parts& parts) {
  std::vector<NumberRange> numbers;
  for (const Part& part : parts) {
    const NumberRange added{std::size_t{3} * part.first_vertex, std::size_t{3} * part.vertex_count};
    if (!numbers.empty() && numbers.back().first + numbers.back().count == added.first)
      numbers.back().count += added.count;
    else
      numbers.push_back(added);
  }
  return numbers;
}

class Call final : public HostWork {
 public:
  explicit Call(std::function<void()> work) : work_(std::move(work)) {}
  void run() override { work_(); }

 private:
  std::function<void()> work_;
};

Pass host_pass(std::function<void()> work) {
  return {.name = "exchange_sums", .call = {}, .item_count = 0, .host_work = std::make_shared<Call>(std::move(work))};
}

}  // namespace

// Numbers are packed by portions, within these by ranks, and then in the order of a rank's parts.
class SharedSums::Exchange {
 public:
  /// `numbers` has each rank's of each portion.
  Exchange(DeviceBodies& bodies, Ranks& ranks, const std::vector<std::vector<std::vector<NumberRange>>>& numbers)
      : device_(bodies.arrays.device()),
        sums_(bodies.arrays.get<double>("spring_sum")),
        ranks_(ranks),
        statuses_(device_.transfer_from(bodies.statuses.id(), {{0, bodies.body_count * sizeof(physics::Status)}})) {
    std::size_t place = 0;
    for (const auto& of_ranks : numbers) {
      Portion portion;
      portion.first = place;
      for (const std::vector<NumberRange>& of_rank : of_ranks) {
        const std::size_t first = place;
        for (const NumberRange& range : of_rank) place += range.count;
        portion.packed.push_back({first - portion.first, place - first});
      }
      portion.count = place - portion.first;
      portion.numbers = of_ranks;
      portion.own = transfer_of(of_ranks[ranks.number()]);
      portions_.push_back(std::move(portion));
    }
    packed_.resize(place);
  }

  [[nodiscard]] std::size_t portion_count() const { return portions_.size(); }

  /// Finds out whether there will be anything to exchange. All ranks find the same.
  void look_for_stale() {
    statuses_->begin();
    await(*statuses_);
    std::vector<physics::Status> statuses(statuses_->bytes().size() / sizeof(physics::Status));
    std::memcpy(statuses.data(), statuses_->bytes().data(), statuses_->bytes().size());
    is_needed_ = std::ranges::any_of(
        statuses, [](const physics::Status& status) { return status.activity == physics::moving && status.force_stale != 0; });
  }
  void expect_all() { is_needed_ = true; }

  /// Is called when a portion's kernels have been queued.
  void fetch(std::size_t portion) {
    if (is_needed_) portions_[portion].own->begin();
  }

  /// Is called after the last one. Expects a portion at least.
  void finish() {
    if (!is_needed_) return;
    for (std::size_t p = 0; p < portions_.size(); ++p) {
      await(*portions_[p].own);
      send(portions_[p]);
      if (p > 0) take(portions_[p - 1]);  // while the device works on
    }
    take(portions_.back());
  }

 private:
  struct Portion {
    std::size_t first = 0, count = 0;               // in packed_
    std::vector<std::vector<NumberRange>> numbers;  // of each rank, in `spring_sum`
    std::vector<NumberRange> packed;                // of each rank, within the portion
    std::unique_ptr<Transfer> own;
  };

  void await(Transfer& transfer) {
    while (!transfer.has_arrived()) ranks_.go_on();
  }

  void send(const Portion& portion) {
    const std::span<double> all = packed(portion);
    std::ranges::copy(portion.own->bytes(), std::as_writable_bytes(all.subspan(portion.packed[ranks_.number()].first)).begin());
    ranks_.begin_sharing(all, portion.packed);
  }

  void take(const Portion& portion) {
    ranks_.end_sharing();
    for (std::size_t rank = 0; rank < ranks_.count(); ++rank)
      if (rank != ranks_.number()) upload(portion, rank);
  }

  std::unique_ptr<Transfer> transfer_of(const std::vector<NumberRange>& numbers) {
    std::vector<ByteRange> bytes;
    for (const NumberRange& range : numbers) bytes.push_back({range.first * sizeof(double), range.count * sizeof(double)});
    return device_.transfer_from(sums_.id(), std::move(bytes));
  }

  std::span<double> packed(const Portion& portion) { return std::span(packed_).subspan(portion.first, portion.count); }

  void upload(const Portion& portion, std::size_t rank) {
    std::span<const double> left = packed(portion).subspan(portion.packed[rank].first);
    for (const NumberRange& range : portion.numbers[rank]) {
      sums_.upload(left.first(range.count), range.first);
      left = left.subspan(range.count);
    }
  }

  Device& device_;
  DeviceArray<double>& sums_;
  Ranks& ranks_;
  std::unique_ptr<Transfer> statuses_;
  std::vector<Portion> portions_;
  std::vector<double> packed_;
  bool is_needed_ = true;
};

SharedSums::SharedSums(DeviceBodies& bodies, const Model& model, const std::vector<bool>& are_clustered, Ranks& ranks)
    : bodies_(&bodies) {
  const std::vector<Parts> of_ranks = share_out(cut(bodies, model, are_clustered, ranks.count()), ranks.count());
  const std::size_t multiprocessors = multiprocessors_of(bodies.arrays.device());
  const std::vector<Parts> own = in_portions(of_ranks[ranks.number()], multiprocessors);
  std::vector<std::vector<std::vector<NumberRange>>> numbers;  // of each rank in each portion
  for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
    const std::vector<Parts> portions = in_portions(of_ranks[rank], multiprocessors);
    numbers.resize(std::max(numbers.size(), portions.size()), std::vector<std::vector<NumberRange>>(of_ranks.size()));
    for (std::size_t p = 0; p < portions.size(); ++p) numbers[p][rank] = numbers_of(portions[p]);
  }
  const std::vector<physics::Body> described = bodies.arrays.get<physics::Body>("body").download();
  std::vector<physics::Share> shares;
  for (std::size_t p = 0; p < own.size(); ++p)
    for (const Part& part : own[p]) {
      if (groups_.empty() || groups_.back().portion != p || groups_.back().variant != part.variant)
        groups_.push_back({p, part.variant, static_cast<std::uint32_t>(shares.size()), 0});
      ++groups_.back().share_count;
      physics::Body body = described[part.body];
      body.unit_force = -1;  // so that what the kernel comes to is the sum itself
      shares.push_back({.body = body,
                        .body_index = part.body,
                        .first_vertex = part.first_vertex,
                        .vertex_count = part.vertex_count,
                        .tableau_row = 0});
    }
  bodies.arrays.make("sum_share", shares);
  exchange_ = std::make_shared<Exchange>(bodies, ranks, numbers);
}

std::vector<Pass> SharedSums::passes(std::uint32_t slot, bool only_stale) const {
  std::vector<Pass> passes;
  if (exchange_->portion_count() == 0) return passes;
  passes.push_back(
      host_pass([exchange = exchange_, only_stale] { only_stale ? exchange->look_for_stale() : exchange->expect_all(); }));
  for (std::size_t portion = 0; portion < exchange_->portion_count(); ++portion) {
    const std::size_t first = passes.size();
    for (const Group& group : groups_) {
      if (group.portion != portion) continue;
      const KernelId kernel = bodies_->arrays.device().force_kernel("sum_springs", group.variant);
      const Parameters parameters = {{"slot", slot}, {"only_stale", only_stale ? 1u : 0u}, {"first_share", group.first_share}};
      passes.push_back(make_pass(bodies_->arrays, "sum_springs", kernel, parameters, group.share_count));
    }
    run_together(std::span(passes).subspan(first));
    passes.push_back(host_pass([exchange = exchange_, portion] { exchange->fetch(portion); }));
  }
  passes.push_back(host_pass([exchange = exchange_] { exchange->finish(); }));
  return passes;
}

}  // namespace pliant
