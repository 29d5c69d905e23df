#include "collision/broad_phase/body_pairs.hpp"

#include <algorithm>

#include "core/expect.hpp"

namespace pliant {

BodyPairs::BodyPairs(DeviceBodies& bodies)
    : bodies_(bodies), most_pairs_(std::max(bodies.body_count * (bodies.body_count - 1) / 2, 1u)) {
  PLIANT_EXPECT(bodies.body_count <= 65535);
  bodies.arrays.make<std::uint32_t>("partner_step", bodies.body_count);
  bodies.arrays.make<glm::uvec2>("near_pair", most_pairs_);
}

Pass BodyPairs::bounding_pass(std::uint32_t half) const {
  return make_pass(bodies_.arrays, "bound_bodies", {{"first_position", bodies_.first_of_half(half)}}, bodies_.vertex_count);
}

Pass BodyPairs::pairing_pass() const {
  return make_pass(bodies_.arrays, "pair_bodies", {}, bodies_.body_count * bodies_.body_count);
}

}  // namespace pliant
