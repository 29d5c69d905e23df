// Sums of squared elongations are the same for every instruction set. tests/simulation/measure_test.cpp has what they are.
#include "dynamics/forces/elongations.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace pliant {
namespace {

class Sample {
 public:
  // Vertices anywhere in a cube of edge 2, moved by up to `amplitude`. What stands behind the last one is no number.
  Sample(std::size_t count, double amplitude) {
    std::mt19937 engine(static_cast<unsigned>(count));
    std::uniform_real_distribution<double> number(-1, 1);
    for (int axis = 0; axis < 3; ++axis) {
      rest_[axis].assign(count + elongation_lanes, std::numeric_limits<double>::quiet_NaN());
      moved_[axis] = rest_[axis];
      for (std::size_t i = 0; i < count; ++i) {
        rest_[axis][i] = number(engine);
        moved_[axis][i] = amplitude * number(engine);
      }
    }
  }

  [[nodiscard]] SpringEnds ends() const {
    return {{rest_[0].data(), rest_[1].data(), rest_[2].data()}, {moved_[0].data(), moved_[1].data(), moved_[2].data()}};
  }

 private:
  std::vector<double> rest_[3], moved_[3];
};

TEST_CASE("squared elongations have the same sum in every instruction set, bit for bit") {
  const ElongationSum portable = elongation_sum(cpu::Isa::portable);
  for (const double amplitude : {1e-9, 0.1, 1e3, 1e150})
    for (const std::size_t count : {1u, 2u, 7u, 8u, 9u, 10u, 16u, 17u, 42u, 101u}) {
      const Sample sample(count, amplitude);
      for (std::size_t i = 0; i < count; ++i) {
        const double expected = portable(sample.ends(), i, count);
        CHECK(expected >= 0);
        for (const cpu::Isa isa : cpu::available_isas()) {
          CAPTURE(amplitude, count, i, cpu::name_of(isa));
          CHECK(std::bit_cast<std::uint64_t>(elongation_sum(isa)(sample.ends(), i, count)) ==
                std::bit_cast<std::uint64_t>(expected));
        }
      }
    }
}

}  // namespace
}  // namespace pliant
