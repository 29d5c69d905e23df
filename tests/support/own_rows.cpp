#include "support/own_rows.hpp"

#include <glm/geometric.hpp>

#include "collision/responses/response.hpp"
#include "core/read_text.hpp"
#include "device/kernel_pack.hpp"
#include "dynamics/forces/force.hpp"
#include "support/paths.hpp"

std::span<const pliant::cpu::KernelEntry> own_kernels_32();
std::span<const pliant::cpu::KernelEntry> own_kernels_64();
std::span<const pliant::cpu::KernelEntry> misread_kernel_32();
std::span<const pliant::cpu::KernelEntry> misread_kernel_64();

namespace pliant {
namespace {

class ChainForce final : public AddedForce {
 public:
  ChainForce(const DeviceBodies& bodies, std::uint32_t body) : bodies_(bodies), body_(body) {}
  std::vector<Pass> passes(std::uint32_t slot, bool is_first) const override {
    return {make_pass(
        bodies_.arrays, "chain_force",
        {{"slot", slot}, {"is_first", is_first ? 1u : 0u}, {"chained_body", body_}, {"chain_stiffness", chain_stiffness}},
        bodies_.vertex_count)};
  }

 private:
  const DeviceBodies& bodies_;
  std::uint32_t body_;
};

bool is_chained(const ModelBody& body) { return !body.is_rigid() && body.name == "chained"; }

std::unique_ptr<AddedForce> make_chain(DeviceBodies& bodies, const Model& model) {
  std::uint32_t body = 0;
  while (!is_chained(model.bodies[body])) ++body;
  return std::make_unique<ChainForce>(bodies, body);
}

double chain_energy(const EnergyQuestion& question) {
  double sum = 0;
  const auto at = [&](std::size_t i, bool moved) {
    const std::vector<double>& u = question.state.motion;
    return glm::dvec3(question.model.rest_positions[i]) +
           (moved ? glm::dvec3(u[6 * i], u[6 * i + 1], u[6 * i + 2]) : glm::dvec3(0.0));
  };
  for (const ModelBody& body : question.model.bodies)
    for (std::uint32_t i = body.first_vertex + 1; is_chained(body) && i < body.first_vertex + body.vertex_count; ++i) {
      const double grown = glm::length(at(i, true) - at(i - 1, true)) - glm::length(at(i, false) - at(i - 1, false));
      sum += 0.5 * chain_stiffness * grown * grown;
    }
  return sum;
}

double chain_energy_scale(const ModelBody& body) { return chain_stiffness * body.radius * body.radius; }
double chain_frequency_squared(const ModelBody& body) { return 4 * chain_stiffness / body.vertex_mass; }

class Halt final : public Response {
 public:
  explicit Halt(const DeviceBodies& bodies) : bodies_(bodies) {}
  std::vector<Pass> after_step(std::uint32_t from_half) const override {
    return {make_pass(bodies_.arrays, "halt_response", {{"from_half", from_half}}, bodies_.vertex_count)};
  }

 private:
  const DeviceBodies& bodies_;
};

std::unique_ptr<Response> make_halt(const ResponseSetting& setting) { return std::make_unique<Halt>(setting.bodies); }

std::string text_beside_this(std::string_view name) { return read_text(source_dir() + "/tests/support/" + std::string(name)); }

constexpr ForceExample all_examples[] = {{"springs", "springs", [](BodyDescription& body) { body.stiffness = 1; }},
                                         {"pressure", "pressure of a gas", [](BodyDescription& body) { body.pressure = 3; }},
                                         {"pressure", "constant pressure",
                                          [](BodyDescription& body) {
                                            body.pressure = 3;
                                            body.pressure_law = PressureLaw::constant;
                                          }},
                                         {"chain", "chain", [](BodyDescription& body) { body.name = "chained"; }}};

}  // namespace

std::span<const ForceExample> force_examples() { return all_examples; }

std::span<const gl::ShaderFile> own_kernel_files() {
  static const std::string chain = text_beside_this("chain_force.glsl"), halt = text_beside_this("halt_response.glsl");
  static const gl::ShaderFile files[] = {{"compute/kernels/chain_force.glsl", chain},
                                         {"compute/kernels/halt_response.glsl", halt}};
  return files;
}

void add_misread_kernel() {
  static const std::string text = text_beside_this("misread.glsl");
  static const gl::ShaderFile files[] = {{"compute/kernels/misread.glsl", text}};
  static const bool once = [] {
    add_kernels({files, misread_kernel_32(), misread_kernel_64()});
    return true;
  }();
  static_cast<void>(once);
}

void add_own_rows() {
  static const bool once = [] {
    add_kernels({own_kernel_files(), own_kernels_32(), own_kernels_64()});
    add_force({.name = "chain",
               .is_zero_at_rest = true,
               .acts_on = is_chained,
               .energy = chain_energy,
               .energy_scale = chain_energy_scale,
               .frequency_squared = chain_frequency_squared,
               .make = make_chain,
               .warnings = nullptr});
    add_response({.name = "halt",
                  .make = make_halt,
                  .elasticity = 0.75,
                  .law_with_gravity = DampingLaw::constant,
                  .allows_immovable = true});
    return true;
  }();
  static_cast<void>(once);
}

}  // namespace pliant
