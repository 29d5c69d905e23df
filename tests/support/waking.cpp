#include "support/waking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "collision/responses/sleep_bounds.hpp"
#include "core/bytes.hpp"
#include "model/mean_edge.hpp"

namespace pliant::test {
namespace {

// Where the bytes of statuses begin. An array has its name before it, and its length.
std::size_t place_of_statuses(std::string_view saved, const Model& model) {
  ByteWriter head;
  head.put(std::string("status"));
  head.put(std::uint64_t{(model.bodies.size() + 1) * sizeof(physics::Status)});
  const std::string name_and_length = head.take();
  const std::size_t place = saved.find(name_and_length);
  REQUIRE(place != std::string_view::npos);
  return place + name_and_length.size();
}

struct BodyBox {
  glm::vec3 lower{std::numeric_limits<float>::infinity()}, upper{-std::numeric_limits<float>::infinity()};
};

BodyBox box_around(const ModelBody& body, const std::vector<glm::vec4>& positions) {
  BodyBox box;
  for (const glm::vec4& p : std::span(positions).subspan(body.first_vertex, body.vertex_count)) {
    box.lower = glm::min(box.lower, glm::vec3(p));
    box.upper = glm::max(box.upper, glm::vec3(p));
  }
  return box;
}

double distance_of(const BodyBox& a, const BodyBox& b) {
  return glm::length(glm::max(glm::max(a.lower - b.upper, b.lower - a.upper), glm::vec3(0.0f)));
}

double farthest(const ModelBody& body, const std::vector<glm::vec4>& from, const std::vector<glm::vec4>& to) {
  double most = 0;
  for (std::uint32_t i = body.first_vertex; i < body.first_vertex + body.vertex_count; ++i)
    most = std::max<double>(most, glm::distance(glm::vec3(from[i]), glm::vec3(to[i])));
  return most;
}

class Judge {
 public:
  Judge(const Window& window, const Model& model, const Stillness& stillness)
      : window_(window), model_(model), stillness_(stillness) {}

  std::vector<std::string> judge() {
    for (const std::uint32_t b : window_.pulled)
      if (window_.after[b].asleep != 0) say(b, "is pulled");
    for (std::uint32_t b = 0; b < model_.bodies.size(); ++b)
      if (window_.slept_through(b)) judge_motion(b);
    judge_impulses();
    judge_nearness();
    return std::move(said_);
  }

 private:
  void say(std::uint32_t b, const std::string& what) {
    said_.push_back(fmt::format("body {} ({}) sleeps and {}", b, model_.bodies[b].name, what));
  }

  void judge_motion(std::uint32_t b) {
    const ModelBody& body = model_.bodies[b];
    const double gone = farthest(body, window_.start, window_.awake);
    if (!(gone <= stillness_.in_half_a_second)) say(b, fmt::format("would go {:.3g} m", gone));
    if (window_.awake_and_let_be.empty()) return;
    const double pulled = farthest(body, window_.awake_and_let_be, window_.awake);
    if (!(pulled <= stillness_.by_a_pull)) say(b, fmt::format("the pull would move it by {:.3g} m", pulled));
  }

  void judge_impulses() {
    std::vector<bool> has_one(model_.bodies.size());
    for (const ContactImpulse& contact : window_.impulses)
      for (int k = 0; k < 4; ++k)
        if (contact.vertex[k] != physics::no_vertex) has_one[model_.body_index(contact.vertex[k])] = true;
    for (std::uint32_t b = 0; b < has_one.size(); ++b)
      if (has_one[b] && window_.slept_through(b)) say(b, "has an impulse");
  }

  // Boxes are rounded, so the bound is a little less than an edge.
  void judge_nearness() {
    std::vector<BodyBox> boxes;
    std::vector<double> edges;
    for (const ModelBody& body : model_.bodies) {
      boxes.push_back(box_around(body, window_.last_start));
      edges.push_back(body.triangle_count > 0 ? mean_edge(model_, body) : 0);
    }
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
      for (std::uint32_t b = 0; b < boxes.size(); ++b)
        if (window_.slept_through(a) && !model_.bodies[b].is_rigid() && window_.after[b].asleep == 0 &&
            distance_of(boxes[a], boxes[b]) < 0.99 * std::min(edges[a], edges[b]))
          say(a, fmt::format("body {} moves beside it", b));
  }

  const Window& window_;
  const Model& model_;
  const Stillness& stillness_;
  std::vector<std::string> said_;
};

std::uint64_t count(const Window& window, const std::function<bool(std::uint32_t)>& holds) {
  std::uint64_t counted = 0;
  for (std::uint32_t b = 0; b < window.before.size(); ++b) counted += holds(b) ? 1 : 0;
  return counted;
}

}  // namespace

std::vector<physics::Status> saved_statuses(std::string_view saved, const Model& model) {
  std::vector<physics::Status> statuses(model.bodies.size() + 1);
  std::memcpy(statuses.data(), saved.data() + place_of_statuses(saved, model), statuses.size() * sizeof(physics::Status));
  return statuses;
}

std::string with_all_awake(std::string saved, const Model& model) {
  std::vector<physics::Status> statuses = saved_statuses(saved, model);
  for (physics::Status& status : statuses) {
    if (status.asleep != 0) status.calm = 0;
    status.asleep = status.falls_asleep = 0;
    status.slow_for = 0;
  }
  std::memcpy(saved.data() + place_of_statuses(saved, model), statuses.data(), statuses.size() * sizeof(physics::Status));
  return saved;
}

std::uint64_t Window::sleepers() const {
  return count(*this, [&](std::uint32_t b) { return slept_through(b); });
}
std::uint64_t Window::woken() const {
  return count(*this, [&](std::uint32_t b) { return before[b].asleep != 0 && after[b].asleep == 0; });
}

Stillness stillness_of(const Model& model, double gravity) {
  const double way = sleep_way(model, gravity);
  return {.in_half_a_second = 2 * way, .by_a_pull = way / 10};
}

Stillness farthest_of_sleepers(const Window& window, const Model& model) {
  Stillness most;
  for (std::uint32_t b = 0; b < model.bodies.size(); ++b) {
    if (!window.slept_through(b)) continue;
    most.in_half_a_second = std::max(most.in_half_a_second, farthest(model.bodies[b], window.start, window.awake));
    if (window.awake_and_let_be.empty()) continue;
    most.by_a_pull = std::max(most.by_a_pull, farthest(model.bodies[b], window.awake_and_let_be, window.awake));
  }
  return most;
}

std::vector<std::string> breaches(const Window& window, const Model& model, const Stillness& stillness) {
  return Judge(window, model, stillness).judge();
}

}  // namespace pliant::test
