#include "device/gpu/peak.hpp"

#include <glad/gl.h>

#include "core/expect.hpp"
#include "device/gpu/gpu_device.hpp"
#include "gl/objects.hpp"

namespace pliant::gpu {
namespace {

constexpr GLuint group_size = 256;
constexpr std::uint64_t steps_per_round = 16, chains = 16;  // of peak.comp

}  // namespace

struct Peak::Impl {
  GLuint groups, rounds;
  gl::Buffer results;
  gl::Program program;
};

Peak::Peak(Device& device) {
  gl::Context* context = context_of(device);
  PLIANT_EXPECT(context != nullptr);
  const bool software = context->adapter().is_software;
  const GLuint groups = software ? 16 : 8192, rounds = software ? 16 : 64;  // about a millisecond
  impl_ = std::make_unique<Impl>(Impl{groups, rounds, gl::Buffer(groups * group_size * sizeof(float), "peak results"),
                                      gl::Program::compute("compute/peak.comp")});
}

Peak::~Peak() = default;

void Peak::run() {
  glUseProgram(impl_->program.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, impl_->results.id());
  glUniform1f(0, 0.75f);  // chains tend to 2
  glUniform1f(1, 0.5f);
  glUniform1ui(2, impl_->rounds);
  glDispatchCompute(impl_->groups, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

std::uint64_t Peak::multiply_adds() const {
  return std::uint64_t{impl_->groups} * group_size * impl_->rounds * steps_per_round * chains;
}

}  // namespace pliant::gpu
