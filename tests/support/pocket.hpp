// Bodies that hook into each other, so that motions are cut short for as long as it takes.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "device/array_list.hpp"
#include "support/impulse_scene.hpp"

namespace pliant {

// A small ball that buries itself in a large one of the same mass, so that motions are cut short for as long as it takes. Both
// fly along.
inline std::vector<BodySetup> pocket_setups(const glm::dvec3& flight) {
  std::vector<BodySetup> setups = {soft(generate_mesh("icosphere:2"), "small"), soft(generate_mesh("icosphere:2"), "large")};
  setups[0].description.scale = 0.14;
  setups[0].description.total_stiffness = 180;
  setups[0].description.position = {-1.35, 0.44, -0.07};
  setups[0].description.velocity = flight + glm::dvec3{4.65, -1.4, 0.35};
  setups[1].description.total_stiffness = 420;
  setups[1].description.velocity = flight - glm::dvec3{4.65, -1.4, 0.35};
  return setups;
}

inline ModelAndState ball_in_a_pocket(const glm::dvec3& flight) { return build_model(pocket_setups(flight), glm::dvec3(0.0)); }

// They hook into each other, and may fly into a wall meanwhile.
inline ModelAndState pocket_before_wall(double speed, double distance) {
  std::vector<BodySetup> setups = pocket_setups({0, 0, speed});
  setups.push_back(soft(generate_mesh("cube:3"), "wall"));
  setups[2].description.kind = BodyKind::immovable;
  setups[2].description.scale = 2;
  setups[2].description.position = {0, 0, distance};
  return build_model(setups, glm::dvec3(0.0));
}

// Cuts motions of so many vertices short, as if they had left their cages.
inline void cut_by_hand(DeviceArray<std::uint32_t>& cut, std::size_t count) {
  std::vector<std::uint32_t> rows = cut.download();
  std::fill_n(rows.begin(), count, 0u);
  cut.upload(rows);
}

}  // namespace pliant
