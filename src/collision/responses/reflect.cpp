#include "collision/responses/reflect.hpp"

namespace pliant {
namespace {

class Reflect final : public Response {
 public:
  explicit Reflect(const ResponseSetting& setting) : bodies_(setting.bodies), elasticity_(elasticity_of(setting.description)) {}

  std::vector<Pass> after_step(std::uint32_t from_half) const override {
    return {make_pass(bodies_.arrays, "reflect", {{"from_half", from_half}, {"elasticity", elasticity_}}, bodies_.vertex_count)};
  }

 private:
  const DeviceBodies& bodies_;
  double elasticity_;
};

std::unique_ptr<Response> make_reflect(const ResponseSetting& setting) { return std::make_unique<Reflect>(setting); }

}  // namespace

ResponseRow reflect_row() { return {.name = "reflect", .make = make_reflect, .follows_frames = true}; }

}  // namespace pliant
