// The suite `contact` measures contact by impulses:
// - whether bodies stay apart at any speed, and keep momentum and energy
// - what an impact gives, by the length of the step: whether it converges, and how it depends on elasticity and stiffness
// - how still bodies rest
// - what contact costs in a step
// - what self-contact costs in a step of a body that does not touch itself
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/common/place.hpp"

namespace pliant::bench {

/// What the suite is made of, in the order of the list above.
enum class ContactStudy { apart, impacts, rest, cost, self };

struct ContactOptions {
  Selection devices;
  std::optional<ContactStudy> only = {};    // all of them without it
  std::filesystem::path scenes = "scenes";  // bunny and teapot lie beside this folder, in meshes
  bool quick = false;                       // a hundredth of the steps
};

// Members' names are the keys of the file. Bodies have a radius of 1 m, and 1 kg and N k = 1000 N/m unless the row says
// otherwise.

/// Two bodies that meet off their centres and part again, with elasticity 0.5 and friction 0.5. They are watched from shortly
/// before their first impulse until they have parted.
struct ApartRow {
  std::string bodies;
  DeviceKind device = DeviceKind::cpu;
  int precision = 64;
  std::uint32_t vertices = 0;       // of both
  double mass_ratio = 1;            // of the second body to the first
  double radius_ratio = 1;          // of the second body to the first
  double far_away = 0;              // from the origin, along each axis [m]
  double edges_a_step = 0;          // how fast they come near each other
  double omega_step = 0;            // step times the stiffest frequency
  std::uint64_t steps = 0;          // watched closely: all parts proven at their ends and at seven times within
  std::uint64_t parts = 0;          // that those fell into
  std::uint64_t parts_in_all = 0;   // until bodies had parted, later ones proven once in 16
  std::uint64_t contact_parts = 0;  // parts with an impulse
  std::uint64_t cut_vertices = 0;   // whose motion was cut short
  std::uint64_t held_parts = 0;     // in which nothing moved
  std::size_t touching = 0;         // pairs of triangles that were not apart
  std::size_t inside = 0;           // vertices inside another body
  bool parted = false;              // the bodies' boxes are apart again in the end
  bool broke_down = false;          // the run ended before, with a non-finite number or too much energy
  double momentum_change = 0;       // over the sum of m |v|
  // The same of bodies as deformed as at most, in as long a time without contacts, by whole steps: the largest of four times
  // after each other, because one random walk may be short.
  double momentum_change_alone = 0;
  double angular_momentum_change = 0;  // over the sum of |x x m v|
  double most_energy = 0;              // above the first, over the kinetic energy then
  double last_energy = 0;              // the same at the end
};

/// One impact of two spheres of 162 vertices.
struct ImpactRow {
  std::string response;
  std::string integrator;
  double stiffness = 1e3;  // N k [N/m]
  double elasticity = 0.5;
  double omega_step = 0;   // step times the stiffest frequency
  double kept = 0;         // of the approach of the centres of mass along x, after the impact
  double most_energy = 0;  // above the start's, over the kinetic energy at the start
  // Distances to the result with the shortest step, over the start's sizes. They are null in the row of that step itself.
  std::optional<double> position_error;  // of a body's centre of mass, over the radius
  std::optional<double> momentum_error;  // of a body, over that at the start
  std::optional<double> spin_error;      // of a body's own angular momentum, over M r v
};

/// Bodies that rest under gravity.
struct RestRow {
  std::string bodies;
  DeviceKind device = DeviceKind::cpu;
  int precision = 64;
  std::uint64_t steps = 0;         // watched
  std::uint64_t contacts = 0;      // impulses in the last one
  std::uint64_t cut_vertices = 0;  // whose motion was cut short
  double most_a_step = 0;          // the longest way of a vertex in a step [edges]
  double drift = 0;                // the farthest that a vertex came from its first place [edges]
};

/// Steps while two spheres press each other the most, beside steps without contact.
struct CostRow {
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  std::uint64_t vertices = 0;       // of a body
  double edges_a_step = 0;          // how fast they come near each other
  std::uint64_t contacts = 0;       // the most impulses in a part of a step, of every sixteenth part
  double microseconds = 0;          // of a part of a step, where three quarters of these or more act
  double microseconds_apart = 0;    // of a step while they are far from each other
  double microseconds_without = 0;  // of the same with response = "none"
};

/// Steps of one body that does not touch itself, with self-contact and without.
struct SelfCostRow {
  std::string mesh;
  DeviceKind device = DeviceKind::cpu;
  int precision = 32;
  std::uint64_t vertices = 0;
  bool rests = false;               // on a ground; else it flies
  std::uint64_t cut_vertices = 0;   // whose motion was cut short
  double microseconds_without = 0;  // of a part of a step
  double microseconds = 0;          // of the same with self-contact
};

using ContactRow = std::variant<ApartRow, ImpactRow, RestRow, CostRow, SelfCostRow>;

struct ContactResult {
  std::vector<ContactRow> rows;
  std::vector<std::string> notes;  // sums over the rows
  bool interrupted = false;        // by Progress
};

/// Runs the suite. Throws Error: device, or input if a mesh is missing.
[[nodiscard]] ContactResult bench_contact(const ContactOptions& options, const Progress& progress);

}  // namespace pliant::bench
