// How bodies answer contacts. A response is one file and one row in a list.
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "device/pass.hpp"
#include "scene/scene_description.hpp"
#include "state/device_bodies.hpp"

namespace pliant {

/// Records the passes of one response. What a contact holds is the response's own: it makes the arrays for it, or uses the marks
/// of touching vertices. No result may depend on the order in which contacts were found.
class Response {
 public:
  virtual ~Response() = default;
  /// Before the integrator's passes, with the state in `from_half`.
  [[nodiscard]] virtual std::vector<Pass> before_step(std::uint32_t from_half) const {
    static_cast<void>(from_half);
    return {};
  }
  /// After the search for touching triangles and, where a tolerance governs steps, after the verdict: the state is in the other
  /// half.
  [[nodiscard]] virtual std::vector<Pass> after_step(std::uint32_t from_half) const = 0;
};

/// What a response is made for; all but the description must outlive it.
struct ResponseSetting {
  DeviceBodies& bodies;
  const Model& model;
  const CollisionDescription& description;
};

struct ResponseRow {
  std::string_view name;  // the scene's `collision.response`
  std::unique_ptr<Response> (*make)(const ResponseSetting& setting);
};

[[nodiscard]] std::span<const ResponseRow> responses();
/// Adds a row of another program's. Scenes read from then on may name it.
void add_response(const ResponseRow& row);
/// Null for "none". Throws Error, blaming the name's origin, for a name that no row has.
[[nodiscard]] const ResponseRow* find_response(const Named& name);

}  // namespace pliant
