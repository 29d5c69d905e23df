// Checks the order conditions of every integrator. Their source is Hairer, Norsett and Wanner, Solving Ordinary Differential
// Equations I: II.2 for Runge-Kutta methods, II.14 with trees for x'' = f(x) for Nystrom methods, and for splittings as such.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "core/error.hpp"
#include "dynamics/integrator.hpp"
#include "support/evolve.hpp"

namespace pliant {
namespace {

using Vector = std::vector<long double>;

struct Residual {
  long double value = 0, scale = 0;  // scale: the same sum over magnitudes
};

// ---- rooted trees ----

struct Tree {
  int order = 1;
  long double density = 1;  // gamma
  std::vector<const Tree*> children;
};

// Every rooted tree up to `order`, smaller ones first.
class Trees {
 public:
  explicit Trees(int order) {
    for (int n = 1; n <= order; ++n) {
      std::vector<const Tree*> none;
      grow(n, n - 1, all_.size(), none);
    }
  }
  const std::vector<std::unique_ptr<Tree>>& all() const { return all_; }

 private:
  // Adds children of descending index until `left` vertices are spent.
  void grow(int order, int left, std::size_t first_forbidden, std::vector<const Tree*>& children) {
    if (left == 0) return add(order, children);
    for (std::size_t i = 0; i < first_forbidden; ++i) {
      if (all_[i]->order > left) break;
      children.push_back(all_[i].get());
      grow(order, left - all_[i]->order, i + 1, children);
      children.pop_back();
    }
  }
  void add(int order, const std::vector<const Tree*>& children) {
    Tree tree{order, static_cast<long double>(order), children};
    for (const Tree* child : children) tree.density *= child->density;
    all_.push_back(std::make_unique<Tree>(tree));
  }
  std::vector<std::unique_ptr<Tree>> all_;
};

Vector product(const Vector& matrix, const Vector& vector) {
  Vector result(vector.size());
  for (std::size_t i = 0; i < vector.size(); ++i)
    for (std::size_t j = 0; j < vector.size(); ++j) result[i] += matrix[i * vector.size() + j] * vector[j];
  return result;
}

long double dot(const Vector& a, const Vector& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Vector magnitudes(Vector values) {
  for (long double& value : values) value = std::abs(value);
  return values;
}

// The elementary weight of `tree` at each stage.
Vector stage_weights(const Tree& tree, const Vector& a, int stages) {
  Vector weights(stages, 1);
  for (const Tree* child : tree.children) {
    const Vector inner = product(a, stage_weights(*child, a, stages));
    for (int i = 0; i < stages; ++i) weights[i] *= inner[i];
  }
  return weights;
}

Residual residual(const Tree& tree, const RungeKutta& method, const Vector& b) {
  const long double value = dot(b, stage_weights(tree, method.a, method.stages)) - 1 / tree.density;
  return {value, dot(magnitudes(b), stage_weights(tree, magnitudes(method.a), method.stages))};
}

// The largest residual over the trees of one order, in units of its sum's magnitude (and 1 at least).
long double worst(const Trees& trees, int order, const RungeKutta& method, const Vector& b) {
  long double largest = 0;
  for (const auto& tree : trees.all()) {
    if (tree->order != order) continue;
    const Residual r = residual(*tree, method, b);
    largest = larger(largest, std::abs(r.value) / std::max(1.0L, r.scale));
  }
  return largest;
}

void check_order(const Trees& trees, const RungeKutta& method, const Vector& b, int order) {
  REQUIRE(static_cast<int>(b.size()) == method.stages);
  for (int n = 1; n <= order; ++n) {
    CAPTURE(n);
    CHECK(worst(trees, n, method, b) < 1e-17L);
  }
  CHECK(worst(trees, order + 1, method, b) > 1e-10L);
}

// ---- Nystrom trees: a node's factors are v (a drift from the step's start) or the double integral of a subtree ----

struct NystromTree {
  int drift_count = 0;
  std::vector<const NystromTree*> children;
  int order = 1;                // of its term in the velocity
  long double coefficient = 1;  // on the exact solution its term's integrand is coefficient * time^(order - 1)
};

class NystromTrees {
 public:
  explicit NystromTrees(int order) {
    for (int n = 1; n <= order; ++n)
      for (int drifts = n - 1; drifts >= 0; --drifts) {
        std::vector<const NystromTree*> none;
        grow(n, drifts, n - 1 - drifts, all_.size(), none);
      }
  }
  const std::vector<std::unique_ptr<NystromTree>>& all() const { return all_; }

 private:
  void grow(int order, int drifts, int left, std::size_t first_forbidden, std::vector<const NystromTree*>& children) {
    if (left == 0) return add(order, drifts, children);
    for (std::size_t i = 0; i < first_forbidden; ++i) {
      if (all_[i]->order + 1 > left) continue;
      children.push_back(all_[i].get());
      grow(order, drifts, left - all_[i]->order - 1, i + 1, children);
      children.pop_back();
    }
  }
  void add(int order, int drifts, const std::vector<const NystromTree*>& children) {
    NystromTree tree{drifts, children, order, 1};
    for (const NystromTree* child : children)
      tree.coefficient *= child->coefficient / static_cast<long double>(child->order * (child->order + 1));
    all_.push_back(std::make_unique<NystromTree>(tree));
  }
  std::vector<std::unique_ptr<NystromTree>> all_;
};

struct NystromMethod {
  Vector a, b, b_position, c;
};

NystromMethod as_nystrom(const Splitting& splitting) {
  NystromMethod method;
  long double time = 0;
  for (std::size_t i = 0; i < splitting.kick.size(); ++i) {
    method.c.push_back(time);
    if (i < splitting.drift.size()) time += splitting.drift[i];
  }
  method.b = splitting.kick;
  for (std::size_t i = 0; i < method.b.size(); ++i) {
    method.b_position.push_back(method.b[i] * (1 - method.c[i]));
    for (std::size_t j = 0; j < method.b.size(); ++j)
      method.a.push_back(j < i ? method.b[j] * (method.c[i] - method.c[j]) : 0.0L);
  }
  return method;
}

NystromMethod as_nystrom(const Nystrom& method, const Vector& b) {
  Vector b_position = b;
  for (std::size_t i = 0; i < b.size(); ++i) b_position[i] *= 1 - method.c[i];
  return {method.a, b, b_position, method.c};
}

NystromMethod magnitudes(const NystromMethod& method) {
  return {magnitudes(method.a), magnitudes(method.b), magnitudes(method.b_position), method.c};
}

Vector stage_weights(const NystromTree& tree, const NystromMethod& method) {
  Vector weights(method.c.size(), 1);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::pow(method.c[i], tree.drift_count);
  for (const NystromTree* child : tree.children) {
    const Vector inner = product(method.a, stage_weights(*child, method));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= inner[i];
  }
  return weights;
}

Residual velocity_residual(const NystromTree& tree, const NystromMethod& method) {
  const NystromMethod sizes = magnitudes(method);
  return {dot(method.b, stage_weights(tree, method)) - tree.coefficient / static_cast<long double>(tree.order),
          dot(sizes.b, stage_weights(tree, sizes))};
}

Residual position_residual(const NystromTree& tree, const NystromMethod& method) {
  const NystromMethod sizes = magnitudes(method);
  return {dot(method.b_position, stage_weights(tree, method)) -
              tree.coefficient / static_cast<long double>(tree.order * (tree.order + 1)),
          dot(sizes.b_position, stage_weights(tree, sizes))};
}

void check_order(const NystromTrees& trees, const NystromMethod& method, int order, long double rounding) {
  REQUIRE(method.b.size() == method.c.size());
  long double next = 0;
  for (const auto& tree : trees.all()) {
    CAPTURE(tree->order);
    const Residual velocity = velocity_residual(*tree, method), position = position_residual(*tree, method);
    if (tree->order <= order) CHECK(std::abs(velocity.value) < rounding * std::max(1.0L, velocity.scale));
    if (tree->order + 1 <= order) CHECK(std::abs(position.value) < rounding * std::max(1.0L, position.scale));
    if (tree->order == order + 1) next = std::max(next, std::abs(velocity.value));
  }
  CHECK(next > 1e-10L);
}

// ---- a plain Runge-Kutta step of x' = v, v' = acceleration(x, v), as an oracle ----

struct Point {
  long double x, v;
};

using Acceleration = long double (*)(Point);
long double damped(Point p) { return -std::sin(p.x) - 0.3L * p.v * std::abs(p.v); }
long double undamped(Point p) { return -std::sin(p.x); }
Acceleration acceleration_for(const Integrator& integrator) {
  return allows_damping(integrator, DampingLaw::adaptive) ? damped : undamped;
}

Point plain_step(const RungeKutta& method, Point start, long double h, Acceleration acceleration) {
  std::vector<Point> slopes;
  Point end = start;
  for (int i = 0; i < method.stages; ++i) {
    Point p = start;
    for (int j = 0; j < i; ++j) {
      p.x += h * method.a[i * method.stages + j] * slopes[j].x;
      p.v += h * method.a[i * method.stages + j] * slopes[j].v;
    }
    slopes.push_back({p.v, acceleration(p)});
    end.x += h * method.b[i] * slopes[i].x;
    end.v += h * method.b[i] * slopes[i].v;
  }
  return end;
}

Point plain_step(const Nystrom& method, Point start, long double h, Acceleration acceleration) {
  Vector accelerations;
  Point end{start.x + h * start.v, start.v};
  for (int i = 0; i < method.stages; ++i) {
    long double x = start.x + method.c[i] * h * start.v;
    for (int j = 0; j < i; ++j) x += h * h * method.a[i * method.stages + j] * accelerations[j];
    accelerations.push_back(acceleration({x, 0}));
    end.x += h * h * method.b[i] * (1 - method.c[i]) * accelerations[i];
    end.v += h * method.b[i] * accelerations[i];
  }
  return end;
}

// A step of x'' = -sin x - rate v. With y = e^(rate t / 2) (x - x(0)) that is y'' = -e^(rate t / 2) sin x + (rate / 2)^2 y.
Point step_without_drag(const Nystrom& method, Point start, long double h, long double rate) {
  Vector accelerations;
  Point y{h * start.v, start.v};
  for (int i = 0; i < method.stages; ++i) {
    long double at = method.c[i] * h * start.v;
    for (int j = 0; j < i; ++j) at += h * h * method.a[i * method.stages + j] * accelerations[j];
    const long double growth = std::exp(rate / 2 * method.c[i] * h);
    accelerations.push_back(growth * undamped({start.x + at / growth, 0}) + rate * rate / 4 * at);
    y.x += h * h * method.b[i] * (1 - method.c[i]) * accelerations[i];
    y.v += h * method.b[i] * accelerations[i];
  }
  const long double decay = std::exp(-rate / 2 * h);
  return {start.x + decay * y.x, decay * (y.v - rate / 2 * y.x)};
}

// A plain step by the method's weights, or by others.
Point plain_step(const Integrator& integrator, Point start, long double h, const Vector* weights = nullptr) {
  const auto step = [&](auto method) {
    if (weights != nullptr) method.b = *weights;
    return plain_step(method, start, h, acceleration_for(integrator));
  };
  if (const auto* method = std::get_if<Nystrom>(&integrator.method)) return step(*method);
  return step(std::get<RungeKutta>(integrator.method));
}

// Returns the accelerations at the stages. `end`, if any, becomes the step's end.
Vector stage_accelerations(const NystromTableau& tableau, Point start, long double h, Acceleration acceleration,
                           Point* end = nullptr) {
  Vector accelerations;
  for (int row = 0;; ++row) {
    Point p{start.x + tableau.c[row] * h * start.v, tableau.keep[row] * start.v};
    for (std::size_t j = 0; j < accelerations.size(); ++j) {
      p.x += h * h * tableau.position[row * tableau.stages + j] * accelerations[j];
      p.v += h * tableau.velocity[row * tableau.stages + j] * accelerations[j];
    }
    if (row == tableau.stages) {
      if (end != nullptr) *end = p;
      return accelerations;
    }
    accelerations.push_back(acceleration(p));
  }
}

Point tableau_step(const Integrator& integrator, Point start, long double h) {
  Point end{};
  (void)stage_accelerations(nystrom_tableau(integrator), start, h, acceleration_for(integrator), &end);
  return end;
}

}  // namespace

TEST_CASE("rooted trees are as many as the literature counts") {
  const Trees trees(9);
  std::map<int, int> count;
  for (const auto& tree : trees.all()) ++count[tree->order];
  const std::map<int, int> expected{{1, 1}, {2, 1}, {3, 2}, {4, 4}, {5, 9}, {6, 20}, {7, 48}, {8, 115}, {9, 286}};
  CHECK(count == expected);
}

TEST_CASE("every Runge-Kutta method satisfies all conditions of its order and not all of the next") {
  const Trees trees(9);
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    check_order(trees, *method, method->b, integrator.order);
    if (method->order_hat > 0) check_order(trees, *method, method->b_hat, method->order_hat);
    if (method->order_hat2 > 0) check_order(trees, *method, method->b_hat2, method->order_hat2);
  }
}

TEST_CASE("every Runge-Kutta method is explicit, and its nodes are the sums of its rows") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<RungeKutta>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    REQUIRE(static_cast<int>(method->a.size()) == method->stages * method->stages);
    const Vector row_sums = product(method->a, Vector(method->stages, 1));
    for (int i = 0; i < method->stages; ++i) {
      CHECK(std::abs(row_sums[i] - method->c[i]) < 1e-17L);
      for (int j = i; j < method->stages; ++j) CHECK(method->a[i * method->stages + j] == 0);
    }
  }
}

TEST_CASE("every Nystrom method satisfies all conditions of its order and not all of the next") {
  const NystromTrees trees(13);
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<Nystrom>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    check_order(trees, as_nystrom(*method, method->b), integrator.order, 1e-17L);
    check_order(trees, as_nystrom(*method, method->b_hat), method->order_hat, 1e-17L);
  }
}

TEST_CASE("every Nystrom method is explicit, and the sums of its rows are half its nodes' squares") {
  for (const Integrator& integrator : integrators()) {
    const auto* method = std::get_if<Nystrom>(&integrator.method);
    if (method == nullptr) continue;
    CAPTURE(integrator.name);
    REQUIRE(static_cast<int>(method->a.size()) == method->stages * method->stages);
    const Vector row_sums = product(method->a, Vector(method->stages, 1));
    for (int i = 0; i < method->stages; ++i) {
      CHECK(std::abs(row_sums[i] - method->c[i] * method->c[i] / 2) < 1e-17L);
      for (int j = i; j < method->stages; ++j) CHECK(method->a[i * method->stages + j] == 0);
    }
  }
}

TEST_CASE("every splitting satisfies all Nystrom conditions of its order and not all of the next") {
  const NystromTrees trees(7);
  for (const Integrator& integrator : integrators()) {
    const auto* splitting = std::get_if<Splitting>(&integrator.method);
    if (splitting == nullptr) continue;
    CAPTURE(integrator.name);
    check_order(trees, as_nystrom(*splitting), integrator.order, 1e-13L);
  }
}

TEST_CASE("a splitting's coefficients read the same backwards and cover the step") {
  for (const Integrator& integrator : integrators()) {
    const auto* splitting = std::get_if<Splitting>(&integrator.method);
    if (splitting == nullptr) continue;
    CAPTURE(integrator.name);
    REQUIRE(splitting->kick.size() == splitting->drift.size() + 1);
    for (const Vector* values : {&splitting->kick, &splitting->drift}) {
      CHECK(*values == Vector(values->rbegin(), values->rend()));
      CHECK(std::abs(dot(*values, Vector(values->size(), 1)) - 1) < 1e-18L);
    }
  }
}

TEST_CASE("a Nystrom tableau takes the step of the method it came from") {
  for (const Integrator& integrator : integrators()) {
    if (staged_method(integrator) == nullptr) continue;
    CAPTURE(integrator.name);
    CHECK(nystrom_tableau(integrator).stages == evaluations_per_step(integrator));
    const Point start{0.7L, -1.1L}, expected = plain_step(integrator, start, 0.4L),
                                    actual = tableau_step(integrator, start, 0.4L);
    CHECK(std::abs(actual.x - expected.x) < 1e-14L);  // the tableau is rounded to double
    CHECK(std::abs(actual.v - expected.v) < 1e-14L);
  }
}

TEST_CASE("a Nystrom tableau with drag takes the method's step of what drag has been taken out of") {
  constexpr long double h = 0.4L;
  for (const Integrator& integrator : integrators()) {
    if (!std::holds_alternative<Nystrom>(integrator.method)) continue;
    for (const long double rate : {0.5L, 3.0L, 10.0L}) {
      CAPTURE(integrator.name, rate);
      const auto& method = std::get<Nystrom>(integrator.method);
      const Point start{0.7L, -1.1L}, expected = step_without_drag(method, start, h, rate);
      Point end{};
      const double drag = static_cast<double>(rate * h);
      (void)stage_accelerations(nystrom_tableau(integrator, Stages::of_result, drag), start, h, undamped, &end);
      CHECK(std::abs(end.x - expected.x) < 1e-14L);
      CHECK(std::abs(end.v - expected.v) < 1e-14L);
    }
  }
}

TEST_CASE("stages that only an error estimate uses cost no force evaluation") {
  CHECK(evaluations_per_step(find_integrator("verlet")) == 1);
  CHECK(evaluations_per_step(find_integrator("srkn11b")) == 11);
  CHECK(evaluations_per_step(find_integrator("dop853")) == 12);
  CHECK(evaluations_per_step(find_integrator("verner78_8")) == 12);
  CHECK(evaluations_per_step(find_integrator("vern8")) == 12);
  CHECK(evaluations_per_step(find_integrator("dprkn8")) == 8);
  CHECK(evaluations_per_step(find_integrator("dprkn12")) == 17);
}

TEST_CASE("error weights are how much farther a step goes than the embedded one would") {
  for (const Integrator& integrator : integrators()) {
    if (!estimates_error(integrator)) continue;
    CAPTURE(integrator.name);
    const StagedMethod& method = *staged_method(integrator);
    CHECK(estimate_order(method) == (integrator.name == "dprkn8" ? 7 : integrator.name == "dprkn12" ? 11 : 8));
    const Vector* embedded[] = {&method.b_hat, &method.b_hat2};
    const NystromTableau tableau = nystrom_tableau(integrator, Stages::of_estimates);
    CHECK(tableau.stages >= nystrom_tableau(integrator).stages);
    const std::vector<double> weights = error_weights(integrator);
    REQUIRE(weights.size() == std::size_t{4} * tableau.stages);
    const Point start{0.7L, -1.1L}, end = plain_step(integrator, start, 0.4L);
    const Vector accelerations = stage_accelerations(tableau, start, 0.4L, acceleration_for(integrator));
    for (std::size_t estimate = 0; estimate < 2; ++estimate) {
      if (embedded[estimate]->empty()) continue;
      const Point other_end = plain_step(integrator, start, 0.4L, embedded[estimate]);
      Point difference{0, 0};
      for (std::size_t j = 0; j < accelerations.size(); ++j) {
        difference.x += 0.4L * 0.4L * weights[4 * j + 2 * estimate] * accelerations[j];
        difference.v += 0.4L * weights[4 * j + 2 * estimate + 1] * accelerations[j];
      }
      CHECK(std::abs(difference.x - (end.x - other_end.x)) < 1e-14L);
      CHECK(std::abs(difference.v - (end.v - other_end.v)) < 1e-14L);
      CHECK(std::abs(difference.v) > 1e-13L);
    }
  }
}

TEST_CASE("an unknown integrator is an input error that lists the known ones") {
  try {
    (void)find_integrator("rk5", {Origin::From::file, "a.toml:3: simulation.integrator"});
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    const std::string text = error.what();
    CHECK(text.find("a.toml:3") == 0);
    CHECK(text.find("rk5") != std::string::npos);
    for (const Integrator& integrator : integrators()) CHECK(text.find(integrator.name) != std::string::npos);
  }
}

TEST_CASE("splittings with negative kicks bear no damping, Nystrom methods the constant one") {
  for (const Integrator& integrator : integrators()) {
    CAPTURE(integrator.name);
    const bool is_nystrom = integrator.name == "dprkn8" || integrator.name == "dprkn12";
    CHECK(allows_damping(integrator, DampingLaw::none));
    CHECK(allows_damping(integrator, DampingLaw::constant) == (integrator.name != "srkn11b"));
    for (const DampingLaw law : {DampingLaw::adaptive, DampingLaw::internal})
      CHECK(allows_damping(integrator, law) == (integrator.name != "srkn11b" && !is_nystrom));
  }
}

}  // namespace pliant
