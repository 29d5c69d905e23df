// The vectorized sums of springs against the textbook's formula in long double, for every instruction set of this machine, and
// the sums of every device against those of fp64.
#include "device/cpu/spring_sums.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <random>

#include "dynamics/stepper.hpp"
#include "support/evolve.hpp"
#include "support/expect_error.hpp"
#include "support/largest_difference.hpp"

namespace pliant::cpu {
namespace {

template <class Real>
struct Sample {
  std::vector<glm::vec<4, Real>> placements;  // positions, then displacements
  std::vector<glm::dvec3> sums;

  explicit Sample(std::size_t count) : placements(2 * count), sums(count) {}
  [[nodiscard]] std::size_t size() const { return sums.size(); }
  glm::vec<4, Real>& position(std::size_t i) { return placements[i]; }
  glm::vec<4, Real>& displacement(std::size_t i) { return placements[size() + i]; }
  SpringBody<Real> body() {
    const auto count = static_cast<std::uint32_t>(size());
    return {placements.data(), placements.data() + size(), count, 0, count, sums.data()};
  }
};

// Vertices anywhere in a cube of edge 2, moved by up to `amplitude`. The sums have to ignore w.
template <class Real>
Sample<Real> random_sample(std::size_t count, double amplitude, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return glm::dvec3(number(engine), number(engine), number(engine)); };
  Sample<Real> sample(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 rest = vector(), change = amplitude * vector();
    sample.position(i) = glm::dvec4(rest + change, 7);
    sample.displacement(i) = glm::dvec4(change, 7);
  }
  return sample;
}

// Every length `factor` times what it was at rest.
template <class Real>
Sample<Real> scaled_sample(std::size_t count, double factor) {
  Sample<Real> sample = random_sample<Real>(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec4 rest(sample.position(i));
    sample.position(i) = factor * rest;
    sample.displacement(i) = (factor - 1) * rest;
  }
  return sample;
}

using Wide = glm::vec<3, long double>;

// (|x| - L) x / |x| for x that has changed by `change`.
Wide hooke(const Wide& x, const Wide& change) {
  const auto length = [](const Wide& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); };
  if (length(x) == 0) return Wide(0);
  return (length(x) - length(x - change)) / length(x) * x;
}

template <class Real>
Wide exact_sum(Sample<Real>& sample, std::size_t i) {
  Wide sum(0);
  for (std::size_t j = 0; j < sample.size(); ++j)
    sum +=
        hooke(Wide(sample.position(i)) - Wide(sample.position(j)), Wide(sample.displacement(i)) - Wide(sample.displacement(j)));
  return sum;
}

// The largest error of a sum, relative to what springs along the relative displacements would add up to.
template <class Real>
long double largest_error(Sample<Real>& sample) {
  long double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    long double magnitudes = 1e-30L;
    for (std::size_t j = 0; j < sample.size(); ++j)
      magnitudes += glm::length(Wide(sample.displacement(i)) - Wide(sample.displacement(j)));
    largest = std::max(largest, glm::length(Wide(sample.sums[i]) - exact_sum(sample, i)) / magnitudes);
  }
  return largest;
}

// The part of all errors that acts like springs of another stiffness.
long double bias(Sample<float>& sample) {
  long double along = 0, whole = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Wide exact = exact_sum(sample, i);
    along += glm::dot(Wide(sample.sums[i]) - exact, exact);
    whole += glm::dot(exact, exact);
  }
  return along / whole;
}

template <class Real>
void sum(Isa isa, Sample<Real>& sample, unsigned threads = 2) {
  ThreadPool pool(threads);
  const SpringBody<Real> body = sample.body();
  SpringSums<Real>(isa).sum(pool, {&body, 1});
}

TEMPLATE_TEST_CASE("vectorized sums of springs are Hooke's law to a few roundings, for any number of vertices", "", float,
                   double) {
  for (const std::size_t count : {1u, 2u, 3u, 15u, 16u, 17u, 63u, 64u, 65u, 129u, 642u, 1000u})
    for (const double amplitude : {0.2, 1e-3}) {
      Sample<TestType> sample = random_sample<TestType>(count, amplitude);
      for (const Isa isa : available_isas()) {
        INFO(name_of(isa) << ", " << count << " vertices, amplitude " << amplitude);
        sum(isa, sample);
        CHECK(largest_error(sample) < 4 * std::numeric_limits<TestType>::epsilon());
      }
    }
}

TEST_CASE("rounding does not stiffen or soften springs that are all strained alike") {
  for (const double strain : {1e-5, 1e-4, 0x1p-12 * 1.23, -0x1p-10, 1e-2, -0.1, 0.3}) {
    Sample<float> sample = scaled_sample<float>(642, 1 + strain);
    for (const Isa isa : available_isas()) {
      INFO(name_of(isa) << ", strain " << strain);
      sum(isa, sample);
      CHECK(std::abs(bias(sample)) < 1e-8L);
    }
  }
}

TEMPLATE_TEST_CASE("a body's sums add up to zero", "", float, double) {
  for (const Isa isa : available_isas()) {
    Sample<TestType> sample = random_sample<TestType>(642, 0.2);
    sum(isa, sample);
    glm::dvec3 total(0);
    double magnitudes = 0;
    for (const glm::dvec3& each : sample.sums) {
      total += each;
      magnitudes += glm::length(each);
    }
    CHECK(glm::length(total) < static_cast<double>(std::numeric_limits<TestType>::epsilon()) * magnitudes);
  }
}

TEMPLATE_TEST_CASE("sums of several bodies are those of each alone, bit for bit, on any number of threads", "", float, double) {
  for (const Isa isa : available_isas()) {
    std::vector<Sample<TestType>> together, alone;
    for (const std::size_t count : {300u, 1u, 1000u, 17u, 2100u, 0u}) together.push_back(random_sample<TestType>(count, 0.1));
    alone = together;
    for (Sample<TestType>& sample : alone) sum(isa, sample, 1);
    SpringSums<TestType> sums(isa);
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
      ThreadPool pool(threads);
      std::vector<SpringBody<TestType>> bodies;
      for (Sample<TestType>& sample : together) bodies.push_back(sample.body());
      sums.sum(pool, bodies);
      for (std::size_t b = 0; b < together.size(); ++b) CHECK(together[b].sums == alone[b].sums);
    }
  }
}

TEMPLATE_TEST_CASE("sums of some vertices are those of all, bit for bit", "", float, double) {
  for (const Isa isa : available_isas())
    for (const std::uint32_t count : {17u, 300u, 2100u}) {
      Sample<TestType> sample = random_sample<TestType>(count, 0.1);
      sum(isa, sample);
      for (const auto& [first, wanted] : {std::pair(0u, 1u), {0u, count}, {count / 3, count / 2}, {count - 1, 1u}}) {
        INFO(name_of(isa) << ", " << wanted << " of " << count << " vertices, from " << first);
        std::vector<glm::dvec3> some(wanted);
        SpringBody<TestType> body = sample.body();
        body.first_wanted = first;
        body.wanted_count = wanted;
        body.sums = some.data();
        ThreadPool pool(2);
        SpringSums<TestType>(isa).sum(pool, {&body, 1});
        CHECK(std::ranges::equal(some, std::span(sample.sums).subspan(first, wanted)));
      }
    }
}

TEMPLATE_TEST_CASE("vertices in one place exert no force on each other", "", float, double) {
  for (const Isa isa : available_isas()) {
    Sample<TestType> sample(40);  // at rest in one place
    sum(isa, sample);
    for (const glm::dvec3& each : sample.sums) CHECK(each == glm::dvec3(0));
    for (std::size_t i = 0; i < sample.size(); ++i) sample.displacement(i).x = -TestType(0.25) * static_cast<TestType>(i);
    sum(isa, sample);  // the vertices were apart at rest
    for (const glm::dvec3& each : sample.sums) CHECK(each == glm::dvec3(0));
  }
}

TEMPLATE_TEST_CASE("strongly compressed and stretched springs stay accurate enough to push back", "", float, double) {
  for (const Isa isa : available_isas())
    for (const double factor : {1e-3, 0.1, 10.0, 1e3, 1e6}) {
      INFO(name_of(isa) << ", lengths times " << factor);
      Sample<TestType> sample = scaled_sample<TestType>(100, factor);
      sum(isa, sample);
      CHECK(largest_error(sample) < 1e-3);
    }
}

TEMPLATE_TEST_CASE("sums stay finite and bounded where all lengths shrink a million times or more", "", float, double) {
  for (const Isa isa : available_isas())
    for (const double factor : {1e-6, 1e-7, 1e-9, 1e-20, 1e-30}) {
      Sample<TestType> sample = scaled_sample<TestType>(100, factor);
      sum(isa, sample);
      for (const glm::dvec3& each : sample.sums) CHECK(glm::length(each) < 100 * 4);  // each spring at most L
    }
}

TEMPLATE_TEST_CASE("vertices nearly in one place, at rest and after, pull no harder than they are apart", "", float, double) {
  const TestType apart = 64 * std::numeric_limits<TestType>::epsilon();
  for (const Isa isa : available_isas())
    for (const TestType factor : {TestType(1e-3), TestType(0.5), TestType(2), TestType(1e3)}) {
      Sample<TestType> sample = scaled_sample<TestType>(100, static_cast<double>(factor));
      for (auto& vector : sample.placements) vector *= apart;
      sum(isa, sample);
      for (const glm::dvec3& each : sample.sums)
        CHECK(glm::length(each) < 100 * 4 * static_cast<double>(apart * std::max(factor, TestType(1))));
    }
}

TEMPLATE_TEST_CASE("sums do not change where all positions and all displacements shift", "", float, double) {
  for (const Isa isa : available_isas()) {
    Sample<TestType> sample = random_sample<TestType>(200, 0.1);
    for (auto& vector : sample.placements)  // numbers of few bits, so that shifting them rounds nothing
      for (int k = 0; k < 3; ++k) vector[k] = std::round(vector[k] * 1024) / 1024;
    Sample<TestType> shifted = sample;
    for (std::size_t i = 0; i < sample.size(); ++i) {
      shifted.position(i) += TestType(0.5);
      shifted.displacement(i) -= TestType(2);
    }
    sum(isa, sample);
    sum(isa, shifted);
    CHECK(shifted.sums == sample.sums);
  }
}

TEMPLATE_TEST_CASE("a placement that is not finite shows in the vertex's sum", "", float, double) {
  for (const TestType value : {std::numeric_limits<TestType>::quiet_NaN(), std::numeric_limits<TestType>::infinity()})
    for (const Isa isa : available_isas())
      for (const std::size_t at : {0u, 37u, 199u}) {
        Sample<TestType> sample = random_sample<TestType>(200, 0.1);
        sample.position(at).y = sample.displacement(at).y = value;
        sum(isa, sample);
        CHECK(!(std::isfinite(sample.sums[at].x) && std::isfinite(sample.sums[at].y) && std::isfinite(sample.sums[at].z)));
      }
}

TEMPLATE_TEST_CASE("a small body's sums on one thread are those on all, bit for bit", "", float, double) {
  for (const Isa isa : available_isas())
    for (const std::size_t count : {1u, 8u, 15u, 16u, 17u, 42u, 162u, 255u, 256u}) {
      CAPTURE(name_of(isa), count);
      Sample<TestType> on_all = random_sample<TestType>(count, 0.1), on_one = on_all;
      sum(isa, on_all);
      SpringSums<TestType>(isa).sum_alone(on_one.body());
      CHECK(on_one.sums == on_all.sums);
    }
}

// A spinning sphere, one that keeps its shape, and a smaller one that spins. Behind them more, that spin too.
std::vector<BodySetup> spheres(std::size_t more) {
  std::vector<BodySetup> bodies = {sphere(3), sphere(1), sphere(2)};
  for (std::size_t k = 0; k < more; ++k) {
    bodies.push_back(sphere(k % 2 == 0 ? 1 : 2));
    bodies.back().description.spin = {0, 2, 1};
  }
  bodies[0].description.spin = {1, 2, 3};
  bodies[1].description.velocity = {0, 1, 0};
  bodies[2].description.spin = {-3, 0, 0};
  bodies[2].description.stiffness = 5;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].description.name = "body " + std::to_string(b);
    bodies[b].description.position.x = 4 * static_cast<double>(b);
  }
  return bodies;
}

// The motions of the first three spheres after some steps by one of the device's ways of summing.
std::vector<double> motion_after(unsigned threads, int precision, std::string_view variant, std::string_view integrator,
                                 std::size_t more = 0) {
  const auto device = make_cpu_device(threads, precision);
  const auto found = std::ranges::find(device->force_variants(), variant, &ForceVariant::name);
  REQUIRE(found != device->force_variants().end());
  const ModelAndState start = build_model(spheres(more), glm::dvec3(0));
  DeviceBodies bodies(*device, start.model, start.state, static_cast<std::size_t>(found - device->force_variants().begin()));
  const Stepper stepper(bodies, start.model, find_integrator(integrator), DampingLaw::none, 0.01);
  device->run(stepper.first_passes());
  for (std::uint32_t step = 0; step < 6; ++step) device->run(stepper.passes(step % 2));
  const std::vector<physics::Tally> tallies = bodies.tallies.download();
  CHECK(tallies[0].force_evaluations > 0);
  CHECK(tallies[1].force_evaluations == 0);
  CHECK(tallies[2].force_evaluations > 0);
  const std::uint32_t end = start.model.bodies[2].first_vertex + start.model.bodies[2].vertex_count;
  std::vector<double> motion = bodies.motions.download(0, std::size_t{physics::motion_size} * end);
  const std::vector<double> other_half = bodies.motions.download(std::size_t{physics::motion_size} * bodies.first_of_half(1),
                                                                 std::size_t{physics::motion_size} * end);
  motion.insert(motion.end(), other_half.begin(), other_half.end());
  return motion;
}

TEMPLATE_TEST_CASE("what earlier bodies have left in scratch memory counts for none", "", float, double) {
  using Real = TestType;
  for (const Isa isa : available_isas()) {
    CAPTURE(name_of(isa));
    Sample<Real> large = random_sample<Real>(600, 0.1), small = random_sample<Real>(37, 0.1, 2), again = small;
    ThreadPool pool(2);
    SpringSums<Real> used(isa), fresh(isa);
    for (glm::vec<4, Real>& placement : large.placements) placement = glm::vec<4, Real>(std::numeric_limits<Real>::quiet_NaN());
    const std::array bodies{large.body(), small.body()};
    used.sum(pool, bodies);
    used.sum(pool, {});
    used.sum(pool, std::array{small.body()});
    fresh.sum(pool, std::array{again.body()});
    CHECK(small.sums == again.sums);
  }
}

TEST_CASE("every way of summing moves bodies as the plain one does, bit for bit alike on any number of threads") {
  for (const int precision : {32, 64})
    for (const std::string_view integrator : {"rk4", "verlet"}) {
      const std::vector<double> plain = motion_after(1, precision, "plain", integrator);
      CHECK(motion_after(3, precision, "plain", integrator) == plain);
      for (const Isa isa : available_isas()) {
        CAPTURE(precision, integrator, name_of(isa));
        const std::vector<double> motion = motion_after(1, precision, name_of(isa), integrator);
        for (const unsigned threads : {2u, 3u, 7u}) CHECK(motion_after(threads, precision, name_of(isa), integrator) == motion);
        double largest = 0;
        for (std::size_t i = 0; i < motion.size(); ++i) largest = larger(largest, std::abs(motion[i] - plain[i]));
        CHECK(largest < (precision == 32 ? 1e-6 : 1e-14));
      }
    }
}

TEST_CASE("bodies move as in a scene of their own, bit for bit, where each of many small ones has a thread") {
  for (const int precision : {32, 64})
    for (const std::string_view integrator : {"rk4", "verlet"}) {
      CAPTURE(precision, integrator);
      const std::vector<double> plain = motion_after(1, precision, "plain", integrator);
      CHECK(motion_after(2, precision, "plain", integrator, 14) == plain);
      for (const Isa isa : available_isas()) {
        CAPTURE(name_of(isa));
        const std::vector<double> few = motion_after(1, precision, name_of(isa), integrator);
        for (const unsigned threads : {1u, 3u}) CHECK(motion_after(threads, precision, name_of(isa), integrator, 14) == few);
      }
    }
}

TEST_CASE("an instruction set's name allows it and what is slower, and another name is an error that lists what there is") {
  const std::vector<Isa> isas{Isa::portable, Isa::avx2};
  CHECK((isas_up_to("avx2", isas) == isas));
  CHECK((isas_up_to("portable", isas) == std::vector{Isa::portable}));
  for (const char* name : {"avx512", "AVX2", "sse"}) {
    const Error error = error_of([&] { return isas_up_to(name, isas); });
    CHECK(error.kind() == ErrorKind::device);
    check_says(error, {"PLIANT_ISA", name, "portable, avx2"});
  }
}

TEST_CASE("what scratch memory a body takes is known beforehand") {
  ThreadPool pool(2);
  for (const std::size_t count : {1, 100, 257, 9000}) {
    CAPTURE(count);
    Sample<float> in_floats(count);
    Sample<double> in_doubles(count);
    SpringSums<float> floats(Isa::portable);
    SpringSums<double> doubles(Isa::portable);
    floats.sum(pool, std::array{in_floats.body()});
    doubles.sum(pool, std::array{in_doubles.body()});
    CHECK(floats.scratch_bytes() == SpringSums<float>::scratch_bytes_of(static_cast<std::uint32_t>(count)));
    CHECK(doubles.scratch_bytes() == SpringSums<double>::scratch_bytes_of(static_cast<std::uint32_t>(count)));
  }
}

TEST_CASE("the widest vectors are the best way of summing") {
  const auto device = make_cpu_device(1, 32);
  const std::size_t best = fastest_force_variant(device->force_variants(), 1000, 1000);
  CHECK(device->force_variants()[best].name == name_of(available_isas().back()));
  CHECK(device->force_variants().size() == available_isas().size() + 1);
}

std::vector<double> spring_forces(Device& device, const ModelAndState& start, std::size_t variant) {
  DeviceBodies bodies(device, start.model, start.state, variant);
  const Stepper stepper(bodies, start.model, find_integrator("verlet"), DampingLaw::none, 0.01);
  device.run(stepper.first_passes());
  const Pass pass = stepper.refresh_passes().front();
  device.run({&pass, 1});
  return bodies.arrays.get<double>("kept_force").download(0, std::size_t{3} * start.model.vertex_count());
}

TEST_CASE("every way of summing springs that a device knows gives the plain sums of fp64", "[gl]") {
  std::vector<BodySetup> setups{two_vertices(), sphere(0), sphere(1), sphere(2)};
  for (std::size_t i = 0; i < setups.size(); ++i) {
    setups[i].description.stretch = {0.8, 1.1, 1};
    setups[i].description.scale = i == 1 ? 1e-3 : 1;
    setups[i].description.stiffness = i == 1 ? 4e4 : 1;  // so that no body's forces are lost beside another's
  }
  setups[2].description.stretch = {1, 1, 1};  // at rest
  const ModelAndState start = build_model(setups, {0, 0, 0});
  const auto reference = spring_forces(*make_cpu_device(1, 64), start, 0);
  for (const TestDevice& test : all_devices())
    for (std::size_t variant = 0; variant < test.device->force_variants().size(); ++variant) {
      CAPTURE(test.name, test.device->force_variants()[variant].name);
      CHECK(largest_difference(spring_forces(*test.device, start, variant), reference) <
            (test.device->precision() == 64 ? 1e-14 : 2e-7));
    }
}

}  // namespace
}  // namespace pliant::cpu
