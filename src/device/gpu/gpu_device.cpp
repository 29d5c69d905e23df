// OpenGL compute as a device: buffers are SSBOs, kernels are programs made of shaders/compute/main.comp around the kernel's file.
#include "device/gpu/gpu_device.hpp"

#include <glad/gl.h>

#include <unordered_map>

#include "core/expect.hpp"
#include "gl/objects.hpp"
#include "physics/control.glsl"

namespace pliant {
namespace {

constexpr GLint item_count_location = 8;

class GpuDevice final : public Device {
 public:
  explicit GpuDevice(int index) : context_(index) {
    const gl::Adapter& adapter = context_.adapter();
    info_ = {.kind = "gpu", .name = adapter.renderer + ", " + adapter.version, .threads = 1};
  }

  const DeviceInfo& info() const override { return info_; }
  int precision() const override { return 32; }
  gl::Context& context() { return context_; }
  GLuint gl_buffer(BufferId buffer) const { return storage(buffer).id(); }

  BufferId allocate(std::size_t bytes, std::string_view label) override {
    buffers_.emplace(next_buffer_, gl::Buffer(bytes, label));
    return next_buffer_++;
  }
  void release(BufferId buffer) override { buffers_.erase(buffer); }
  std::size_t size_of(BufferId buffer) const override { return storage(buffer).size(); }
  std::size_t allocated_bytes() const override {
    std::size_t bytes = 0;
    for (const auto& [id, buffer] : buffers_) bytes += buffer.size();
    return bytes;
  }
  void write(BufferId buffer, std::size_t first_byte, std::span<const std::byte> data) override {
    buffers_.at(buffer).write(first_byte, data);
  }
  void read(BufferId buffer, std::size_t first_byte, std::span<std::byte> data) override {
    storage(buffer).read(first_byte, data);
  }

  KernelId kernel(std::string_view name) override {
    for (std::size_t k = 0; k < kernels_.size(); ++k)
      if (kernels_[k].name == name) return static_cast<KernelId>(k);
    const gl::Define defines[] = {{"@kernel", "compute/kernels/" + std::string(name) + ".glsl"}, {"KERNEL", std::string(name)}};
    Kernel made{std::string(name), gl::Program::compute("compute/main.comp", defines), {}, {}};
    made.parameter_exists[max_parameters] = true;
    for (std::size_t slot = 0; slot < max_parameters; ++slot) made.parameter_exists[slot] = has_location(made.program.id(), slot);
    kernels_.push_back(std::move(made));
    return static_cast<KernelId>(kernels_.size() - 1);
  }

  void run(const KernelCall& call, std::uint32_t item_count) override {
    if (item_count == 0) return;
    const std::uint32_t groups = physics::groups_for(item_count);
    const std::uint32_t rows = (groups + physics::max_groups - 1) / physics::max_groups;
    prepare(call, item_count);
    glDispatchCompute(std::min(groups, physics::max_groups), rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }
  void run_indirect(const KernelCall& call, BufferId group_counts, std::size_t first_byte) override {
    prepare(call, 0xffffffffu);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, storage(group_counts).id());
    glDispatchComputeIndirect(static_cast<GLintptr>(first_byte));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }
  void finish() override { glFinish(); }

 private:
  struct Kernel {
    std::string name;
    gl::Program program;
    std::array<bool, max_parameters + 1> parameter_exists;
    std::array<Parameter, max_parameters + 1> parameters;  // as last set; program uniforms start as zero
  };

  static bool has_location(GLuint program, std::size_t slot) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    for (GLuint k = 0; k < static_cast<GLuint>(count); ++k) {
      const GLenum property = GL_LOCATION;
      GLint location = -1;
      glGetProgramResourceiv(program, GL_UNIFORM, k, 1, &property, 1, nullptr, &location);
      if (location == static_cast<GLint>(slot)) return true;
    }
    return false;
  }

  const gl::Buffer& storage(BufferId buffer) const { return buffers_.at(buffer); }

  void prepare(const KernelCall& call, std::uint32_t item_count) {
    Kernel& kernel = kernels_[call.kernel];
    glUseProgram(kernel.program.id());
    for (std::size_t slot = 0; slot < max_buffers; ++slot)
      if (call.buffers[slot] != 0)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(slot), gl_buffer(call.buffers[slot]));
    for (std::size_t slot = 0; slot < max_parameters; ++slot) set_parameter(kernel, slot, call.parameters[slot]);
    set_parameter(kernel, static_cast<std::size_t>(item_count_location), item_count);
  }

  static void set_parameter(Kernel& kernel, std::size_t slot, const Parameter& value) {
    if (!kernel.parameter_exists[slot] || kernel.parameters[slot] == value) return;
    kernel.parameters[slot] = value;
    const GLint location = static_cast<GLint>(slot);
    if (const auto* number = std::get_if<double>(&value))
      glUniform1d(location, *number);
    else
      glUniform1ui(location, std::get<std::uint32_t>(value));
  }

  gl::Context context_;
  DeviceInfo info_;
  std::unordered_map<BufferId, gl::Buffer> buffers_;
  std::vector<Kernel> kernels_;
  BufferId next_buffer_ = 1;
};

}  // namespace

std::unique_ptr<Device> make_gpu_device(int index) { return std::make_unique<GpuDevice>(index); }

gl::Context* gpu::context_of(Device& device) {
  auto* gpu = dynamic_cast<GpuDevice*>(&device);
  return gpu == nullptr ? nullptr : &gpu->context();
}

std::uint32_t gpu::gl_buffer_of(Device& device, BufferId buffer) {
  return dynamic_cast<const GpuDevice&>(device).gl_buffer(buffer);
}

}  // namespace pliant
