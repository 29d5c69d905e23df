// Holds the simulation's arrays on a device, by the names of physics/arrays.glsl. Passes find them there.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/array_list.hpp"
#include "device/device.hpp"
#include "physics/body.glsl"
#include "physics/collision/grid.glsl"
#include "physics/collision/treelet.glsl"
#include "physics/contact/cluster.glsl"
#include "physics/contact/debt.glsl"
#include "physics/contact/part_sums.glsl"
#include "physics/contact/parts.glsl"
#include "physics/contact/surface.glsl"
#include "physics/control.glsl"
#include "physics/forces/clusters.glsl"
#include "physics/forces/pressure.glsl"
#include "physics/pace.glsl"
#include "physics/path.glsl"
#include "physics/pull.glsl"
#include "physics/quiet.glsl"
#include "physics/rigid_motion.glsl"
#include "state/shared_memory.hpp"

namespace pliant {

/// A part of a device's array that one step leaves for the next.
struct CarriedArray {
  std::string name;
  BufferId buffer = 0;
  std::size_t first_byte = 0, byte_count = 0;
  bool is_real = false;  // numbers of the device's precision. Others are the same on every device
};

/// The name of T in physics/arrays.glsl. Empty if T has none.
template <class T>
inline constexpr std::string_view element_name{};
#define PLIANT_ELEMENT(T, name) \
  template <>                   \
  inline constexpr std::string_view element_name<T> = name;
PLIANT_ELEMENT(double, "double")
PLIANT_ELEMENT(std::uint32_t, "uint")
PLIANT_ELEMENT(glm::vec4, "vec4")
PLIANT_ELEMENT(glm::vec2, "vec2")
PLIANT_ELEMENT(glm::uvec2, "uvec2")
PLIANT_ELEMENT(glm::uvec4, "uvec4")
PLIANT_ELEMENT(glm::dvec2, "dvec2")
PLIANT_ELEMENT(physics::Body, "Body")
PLIANT_ELEMENT(physics::Share, "Share")
PLIANT_ELEMENT(physics::Pose, "Pose")
PLIANT_ELEMENT(physics::FrameChange, "FrameChange")
PLIANT_ELEMENT(physics::BoxBits, "BoxBits")
PLIANT_ELEMENT(physics::Status, "Status")
PLIANT_ELEMENT(physics::GridEntry, "GridEntry")
PLIANT_ELEMENT(physics::Treelet, "Treelet")
PLIANT_ELEMENT(physics::Tally, "Tally")
PLIANT_ELEMENT(physics::Control, "Control")
PLIANT_ELEMENT(physics::Pace, "Pace")
PLIANT_ELEMENT(physics::Pressure, "Pressure")
PLIANT_ELEMENT(physics::SpringCluster, "SpringCluster")
PLIANT_ELEMENT(physics::Moments, "Moments")
PLIANT_ELEMENT(physics::RigidMotion, "RigidMotion")
PLIANT_ELEMENT(physics::PartSums, "PartSums")
PLIANT_ELEMENT(physics::Surface, "Surface")
PLIANT_ELEMENT(physics::Room, "Room")
PLIANT_ELEMENT(physics::Ground, "Ground")
PLIANT_ELEMENT(physics::StepParts, "StepParts")
PLIANT_ELEMENT(physics::ContactList, "ContactList")
PLIANT_ELEMENT(physics::Debt, "Debt")
PLIANT_ELEMENT(physics::Cluster, "Cluster")
PLIANT_ELEMENT(physics::Path, "Path")
PLIANT_ELEMENT(physics::PathKey, "PathKey")
PLIANT_ELEMENT(physics::PathState, "PathState")
PLIANT_ELEMENT(physics::Aim, "Aim")
PLIANT_ELEMENT(physics::QuietBody, "QuietBody")
PLIANT_ELEMENT(physics::QuietSteps, "QuietSteps")
PLIANT_ELEMENT(physics::GripVertex, "GripVertex")
#undef PLIANT_ELEMENT

/// Returns the same name. Compiles only if there is one.
template <class T>
consteval std::string_view expected_element() {
  static_assert(!element_name<T>.empty(), "physics/arrays.glsl has no name for this type: add a PLIANT_ELEMENT");
  return element_name<T>;
}

/// Owns arrays. Throws std::logic_error, which names array and types, for these bugs of the caller:
/// - The name is not in the list.
/// - Nobody has made the array.
/// - The type is not the list's.
class Arrays {
 public:
  /// `device` must outlive the arrays.
  explicit Arrays(Device& device) : device_(device), shared_(device) {}
  Arrays(const Arrays&) = delete;
  Arrays& operator=(const Arrays&) = delete;

  /// Makes an array of `count` elements. It replaces an earlier one of that name and makes references to it invalid. An array
  /// that shares memory (state/shared_memory.hpp) may hold anything. Those are to be made before anything is written to one of
  /// them.
  template <class T>
  DeviceArray<T>& make(std::string_view name, std::size_t count, Content content = Content::zeros) {
    return hold(name, expected_element<T>(), allocate<T>(name, count, content));
  }
  template <class T>
  DeviceArray<T>& make(std::string_view name, const std::vector<T>& values) {
    DeviceArray<T>& array = make<T>(name, values.size(), Content::anything);
    array.upload(values);
    return array;
  }
  /// Makes an array of `count` numbers of the device's precision, as words of 32 bits.
  DeviceArray<std::uint32_t>& make_reals(std::string_view name, std::size_t count, Content content = Content::zeros);

  template <class T>
  [[nodiscard]] DeviceArray<T>& get(std::string_view name) const {
    return *static_cast<DeviceArray<T>*>(find(name, expected_element<T>()).array.get());
  }
  [[nodiscard]] BufferId buffer(std::string_view name) const;
  /// Returns the buffers of those arrays that somebody has made.
  [[nodiscard]] std::vector<BufferId> made_buffers(std::span<const std::string_view> names) const;
  [[nodiscard]] Device& device() const { return device_; }

  /// Sets a parameter that has one value for all kernels.
  void set_parameter(std::string_view name, Parameter value) { parameters_.insert_or_assign(std::string(name), value); }
  [[nodiscard]] const Parameter* parameter(std::string_view name) const;

  /// Says which bytes of a carried array are carried. Without this call all of them are.
  void carry_part(std::string_view name, std::size_t first_byte, std::size_t byte_count);
  /// Returns the carried arrays that have been made, in the order of the list. A run needs no others to go on.
  [[nodiscard]] std::vector<CarriedArray> carried() const;

 private:
  struct Held {
    std::shared_ptr<void> array;  // a DeviceArray
    CarriedArray bytes;
  };

  template <class T>
  std::shared_ptr<DeviceArray<T>> allocate(std::string_view name, std::size_t count, Content content) {
    if (!shares_memory(name)) return std::make_shared<DeviceArray<T>>(device_, count, name, content);
    const BufferId part = shared_.place(name, std::max<std::size_t>(count, 1) * sizeof(T));
    return std::make_shared<DeviceArray<T>>(device_, part, count);
  }
  template <class T>
  DeviceArray<T>& hold(std::string_view name, std::string_view element, std::shared_ptr<DeviceArray<T>> array) {
    expect_element(name, element);
    DeviceArray<T>& made = *array;
    const CarriedArray bytes{std::string(name), made.id(), 0, made.size() * sizeof(T), element == "real"};
    held_.insert_or_assign(std::string(name), Held{std::move(array), bytes});
    return made;
  }
  static void expect_element(std::string_view name, std::string_view element);
  const Held& find(std::string_view name, std::string_view element) const;

  Device& device_;
  SharedMemory shared_;
  std::map<std::string, Held, std::less<>> held_;
  std::map<std::string, Parameter, std::less<>> parameters_;
};

using Parameters = std::vector<std::pair<std::string_view, Parameter>>;  // by name

/// Returns a dispatch of a kernel, with the arrays that it names. The kernel's parameters are found by name: in `parameters`,
/// then among those that all kernels share. `item_count` is a parameter, too. Throws std::logic_error, which names the kernel and
/// the array or parameter, in these cases:
/// - An array or a parameter is missing, or of another type. A view (READ_AS) has the right type if its numbers have the array's.
/// - The kernel does not declare one of `parameters`.
/// - The kernel names two arrays that may stand in the same memory.
[[nodiscard]] Pass make_pass(const Arrays& arrays, std::string_view name, const Parameters& parameters, std::uint32_t item_count);
/// Does the same for a kernel in a variant. `name` is for reports.
[[nodiscard]] Pass make_pass(const Arrays& arrays, std::string_view name, KernelId kernel, const Parameters& parameters,
                             std::uint32_t item_count);
/// Does the same for a kernel in rounds, with as many work groups as run at once.
[[nodiscard]] Pass make_round_pass(const Arrays& arrays, std::string_view name, const Parameters& parameters);

}  // namespace pliant
