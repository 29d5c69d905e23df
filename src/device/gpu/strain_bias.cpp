#include "device/gpu/strain_bias.hpp"

#define REAL_BITS 64
#include <glad/gl.h>

#include <random>
#include <span>
#include <vector>

#include "gl/objects.hpp"
#include "physics/forces/spring.glsl"

namespace pliant::gpu {
namespace {

constexpr GLuint group_size = 64, group_count = 1024;  // of strain_bias.comp
constexpr std::size_t spring_count = std::size_t{group_size} * group_count;

class Points {
 public:
  glm::dvec3 in_ball() {
    while (true) {
      const glm::dvec3 point(coordinate_(engine_), coordinate_(engine_), coordinate_(engine_));
      if (glm::dot(point, point) < 1) return point;
    }
  }

 private:
  std::mt19937 engine_{1};
  std::uniform_real_distribution<double> coordinate_{-1, 1};
};

// Returns [spring][2]: the vector from one point to another, and a change of it by up to 2 % of the ball's radius.
std::vector<glm::vec4> random_springs() {
  Points points;
  std::vector<glm::vec4> springs;
  for (std::size_t i = 0; i < spring_count; ++i) {
    const glm::dvec3 x = points.in_ball() - points.in_ball();
    springs.emplace_back(glm::vec3(x), 0.0f);
    springs.emplace_back(glm::vec3(0.02 * points.in_ball()), 0.0f);
  }
  return springs;
}

std::vector<float> strains_of(std::span<const glm::vec4> springs) {
  gl::Buffer inputs(springs.size_bytes(), "springs"), outputs(spring_count * sizeof(float), "strains");
  inputs.write(0, std::as_bytes(springs));
  const gl::Program program = gl::Program::compute("compute/strain_bias.comp");
  glUseProgram(program.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, inputs.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, outputs.id());
  glDispatchCompute(group_count, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<float> strains(spring_count);
  outputs.read(0, std::as_writable_bytes(std::span(strains)));
  return strains;
}

}  // namespace

double measure_strain_bias() {
  const std::vector<glm::vec4> springs = random_springs();
  const std::vector<float> strains = strains_of(springs);
  double excess = 0, whole = 0;  // of forces, because short springs are strained more but pull no harder
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const glm::dvec3 x(springs[2 * i]), d(springs[2 * i + 1]);
    const double exact = physics64::spring_strain(x, d);
    excess += (static_cast<double>(strains[i]) - exact) * exact * glm::dot(x, x);
    whole += exact * exact * glm::dot(x, x);
  }
  return excess / whole;
}

}  // namespace pliant::gpu
