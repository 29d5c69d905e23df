#include "view/scene_view.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace pliant::view {
namespace {

// Returns the speed of the fastest vertex at the start, but at least one that crosses the scene in two seconds.
double top_speed_of(const Session& session, const render::SceneBox& box) {
  double top = box.radius();
  for (const glm::dvec3& velocity : session.start().world_velocities(session.model())) top = std::max(top, glm::length(velocity));
  return top;
}

}  // namespace

SceneView::SceneView(Session& session, const glm::uvec2& size, render::Detail detail)
    : session_(session),
      options_(render::live_options(session.model(), session.start(), session.scene().output, size, detail)),
      top_speed_(top_speed_of(session, options_.scene)),
      bodies_version_(session.bodies_version()),
      renderer_(session.model(), options_) {}

void SceneView::draw(const Look& wanted) {
  if (std::exchange(bodies_version_, session_.bodies_version()) != session_.bodies_version()) {
    renderer_.set_bodies(session_.model());
    drawn_.reset();
  }
  if (drawn_ == wanted) return;
  drawn_.reset();
  renderer_.resize(wanted.size);
  renderer_.set_camera(wanted.camera);
  renderer_.set_fill(wanted.shows.wireframe ? render::Fill::wireframe : render::Fill::surface);
  renderer_.set_coloring(wanted.shows.colors == Colors::deformation ? Coloring::deformation : Coloring::body);
  renderer_.set_speeds(speeds(wanted.shows.colors));
  const render::DrawnBuffer positions = buffers_.positions(session_.device(), session_.simulation());
  renderer_.draw(positions.id, positions.first_vertex);
  lines_ = lines(wanted.shows);
  drawn_ = wanted;
}

std::optional<render::Speeds> SceneView::speeds(Colors colors) {
  if (colors != Colors::speed) return {};
  const render::DrawnBuffer motions = buffers_.motions(session_.device(), session_.simulation());
  return render::Speeds{motions.id, motions.first_vertex, top_speed_};
}

// Reads the state back to the CPU, but only if lines are wanted.
Lines SceneView::lines(const Shows& shows) {
  Lines lines;
  if (!shows.velocities && !shows.contacts && !shows.tree_level) return lines;
  Simulation& simulation = session_.simulation();
  const State state = simulation.state();
  const std::vector<glm::dvec3> positions = state.world_positions(session_.model());
  if (shows.tree_level) add_boxes(lines, simulation.collider().forest(), positions, *shows.tree_level);
  if (shows.velocities) add_velocities(lines, positions, state.world_velocities(session_.model()));
  if (shows.contacts) render::add_contacts(lines, simulation, session_.model(), positions);
  return lines;
}

void SceneView::show() {
  renderer_.copy_to_window();
  if (lines_.empty()) return;
  if (!overlay_) overlay_.emplace();
  overlay_->draw(lines_, drawn_->camera, drawn_->size);
}

}  // namespace pliant::view
