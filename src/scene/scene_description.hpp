// What a scene file says, checked for form and range, with every default filled in. Nothing is loaded or built.
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/origin.hpp"
#include "mesh/subdivide.hpp"

namespace pliant {

/// A value that a later layer resolves, with the place to name when it cannot.
struct Named {
  std::string value;
  Origin where = {};
};

enum class BodyKind { soft, immovable, scripted };
enum class PressureLaw { gas, constant };
/// How a body's springs are summed: one by one, or many at once by clusters of vertices (dynamics/clusters).
enum class ForceSum { automatic, direct, clustered };
enum class DampingLaw : unsigned { none = 0, constant = 1, adaptive = 2, internal = 3 };
/// Returns the law's name in scenes and reports.
constexpr const char* name_of(DampingLaw law) {
  constexpr const char* names[] = {"none", "constant", "adaptive", "internal"};
  return names[static_cast<unsigned>(law)];
}
/// How pairs of bodies are found. Results do not depend on it, and no scene says it: tests do.
enum class BroadPhase { automatic, all_pairs, grid };
enum class ContactSearch { tree, brute_force };
enum class TriangleTest : unsigned { certified = 0, moller = 1 };
enum class Coloring { body, deformation };
enum class Marks { none, contacts };

struct SimulationDescription {
  Named integrator{"dop853", {Origin::From::nowhere, "simulation.integrator"}};
  std::optional<double> time_step;  // [s], automatic if empty
  std::optional<double> tolerance;  // of a step's error, relative to the bodies. If set, steps have no fixed length
  double duration = 2.0;            // [s]
  Origin time_step_where, tolerance_where, duration_where;
  std::optional<DampingLaw> damping_law;  // by the response and gravity if empty
  glm::dvec3 gravity{0.0};                // [m/s^2]
  bool sleep = false;                     // whether bodies that rest on something stop to move
  Origin sleep_where;                     // of the key `sleep`
};

/// A key that the scene has, and that changes nothing.
struct IdleKey {
  Origin where;
  std::string_view why;
};

/// How a node's triangles are shared out between its children (collision/trees/split.hpp).
enum class TreeSplit {
  centre,  // at the centre of the longest axis of their box, by centroids, as in the paper
  median,  // half of them each, but for a leaf, along the axis on which the children's boxes have the least surface together
  surface_area,  // where the children's surfaces, each times its number of triangles, are least together
};

/// When nodes' boxes are fitted (collision/trees/tree_search.hpp). Source: T. Larsson, T. Akenine-Möller, "Collision detection
/// for continuously deforming bodies", Eurographics 2001.
enum class TreeRefit {
  bottom_up,  // all of near bodies, before the search
  hybrid,     // treelets are bounded first, and those that meet one of another body are refitted
};

struct TreeDescription {
  TreeSplit split = TreeSplit::median;
  unsigned fan_out = 8;                    // children of a node, at most
  std::optional<TreeRefit> refit = {};     // if empty, what suits the device
  std::optional<unsigned> max_depth = {};  // splits from the root to a leaf. If empty, it grows with the triangle count
  unsigned leaf_size = 4;                  // triangles

  bool operator==(const TreeDescription&) const = default;
};

struct CollisionDescription {
  Named response{"impulse"};              // a name in the list of responses, or "none"
  std::optional<double> elasticity = {};  // the response's default if empty
  double friction = 0.5;
  std::optional<double> restitution = {};  // of bodies that have none of their own
  double gap = 0.05;                       // that contacts keep, in mean edges of the meshes
  BroadPhase broad_phase = BroadPhase::automatic;
  ContactSearch search = ContactSearch::tree;
  Origin search_where = {};  // of the key `search`
  TriangleTest triangle_test = TriangleTest::certified;
  TreeDescription tree{};
  // Of the search's lists. No key sets them: what they lack costs speed alone.
  std::uint32_t leaf_pair_capacity = 1u << 18, treelet_pair_capacity = 1u << 16;
  std::vector<Origin> surface_keys = {};  // given ones that not all responses read
};

/// What contacts know of a body or a ground. What is empty is the scene's.
struct SurfaceDescription {
  std::optional<double> elasticity;
  std::optional<double> friction;
  std::optional<double> gap;  // in mean edges of the mesh

  bool operator==(const SurfaceDescription&) const = default;
};

struct CameraDescription {
  glm::dvec3 eye{0.0};          // [m]
  glm::dvec3 target{0.0};       // [m]
  double field_of_view = 40.0;  // vertical [degrees]

  bool operator==(const CameraDescription&) const = default;
};

struct OutputDescription {
  double frame_rate = 60.0;                 // frames per simulated second
  glm::uvec2 size{1280, 720};               // [pixels]
  std::optional<CameraDescription> camera;  // frames the scene if empty
  Coloring coloring = Coloring::body;
  Marks marks = Marks::none;            // drawn over bodies
  std::optional<double> ground_height;  // [m], just below where the bodies start if empty

  bool operator==(const OutputDescription&) const = default;
};

/// Returns the linear RGB colour of the body with this index. Seven colours take turns. The colour-blind can tell them apart, too
/// (Okabe and Ito, 2008).
[[nodiscard]] glm::dvec3 default_color(std::size_t index);

/// Where a scripted body is at a time, beside its position and rotation.
struct PathKeyDescription {
  double time = 0;           // [s]
  glm::dvec3 position{0.0};  // [m]
  glm::dvec3 rotation{0.0};  // [degrees] as that of a body

  bool operator==(const PathKeyDescription&) const = default;
};

struct BodyDescription {
  std::string name;
  BodyKind kind = BodyKind::soft;  // an immovable body keeps its place and shape, a scripted one its shape
  bool is_container = false;       // holds the others, so pictures show its far walls alone
  std::string mesh;                // "generator:argument", or a path
  std::string where;               // "file:line", for errors about this body
  Origin kind_where;               // of the key `kind`
  Origin mesh_where;               // of the key `mesh`
  std::optional<double> weld;      // [m], off if empty
  unsigned subdivide = 0;          // how often, after welding
  Origin subdivide_where;          // of the key `subdivide`
  Subdivision subdivision = Subdivision::midpoint;
  double scale = 1.0;                     // [m per mesh unit]
  glm::dvec3 position{0.0};               // [m]
  glm::dvec3 rotation{0.0};               // [degrees] about the fixed world axes: R = Rz Ry Rx
  glm::dvec3 velocity{0.0};               // [m/s]
  glm::dvec3 spin{0.0};                   // [rad/s] about the centroid
  std::vector<PathKeyDescription> path;   // of a scripted body, by time. If empty, it keeps its velocity and spin
  bool repeats = false;                   // whether the path begins anew behind its last key
  glm::dvec3 stretch{1.0};                // factors along the body's axes about its centroid
  double stiffness = 40.0;                // k of every pair's spring [N/m]
  std::optional<double> total_stiffness;  // [N/m], k = total / N^2
  double vertex_mass = 1.0;               // [kg]
  std::optional<double> total_mass;       // [kg], m = total / N
  double damping = 1.0;                   // c [kg/s]
  ForceSum forces = ForceSum::automatic;  // automatic: clustered for a dense body that has a force_tolerance
  std::optional<double> force_tolerance;  // relative error of clustered forces; 1e-3 if empty
  SurfaceDescription surface;
  std::optional<double> restitution = {};  // the scene's if empty; a static body then has none
  bool self_contact = false;               // whether contacts keep the body's own surface from passing through itself
  Origin self_contact_where;               // of the key `self_contact`
  double pressure = 0.0;                   // inside, at the rest volume, with nothing outside [Pa]
  PressureLaw pressure_law = PressureLaw::gas;
  glm::dvec3 color = default_color(0);  // linear RGB, 0 to 1
  std::vector<Origin> surface_keys;     // as in CollisionDescription
  std::vector<IdleKey> idle_keys;
};

/// A half-space that bodies stay out of.
struct GroundDescription {
  glm::dvec3 point{0.0};             // on its surface [m]
  glm::dvec3 normal{0.0, 1.0, 0.0};  // out of it, of any length
  SurfaceDescription surface;
  Origin where;  // of its table
};

/// Returns the ground that pictures show as their floor: the first level one, or null if there is none.
[[nodiscard]] const GroundDescription* level_ground(std::span<const GroundDescription> grounds);

struct SceneDescription {
  std::string title;
  std::string about;           // what the scene shows, and what to try
  std::filesystem::path file;  // mesh paths are relative to its folder
  SimulationDescription simulation;
  CollisionDescription collision;
  OutputDescription output;
  std::vector<BodyDescription> bodies;  // containers stand behind all others
  std::vector<GroundDescription> grounds;
};

}  // namespace pliant
