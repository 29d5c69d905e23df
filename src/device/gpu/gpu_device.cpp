// Makes OpenGL compute a device. Buffers are SSBOs. Kernels are programs: shaders/compute/main.comp around the kernel's file.
#include "device/gpu/gpu_device.hpp"

#include <fmt/format.h>
#include <glad/gl.h>

#include <optional>
#include <unordered_map>

#include "core/error.hpp"
#include "core/expect.hpp"
#include "device/buffer_part.hpp"
#include "device/gpu/kernel_source.hpp"
#include "device/gpu/lanes.hpp"
#include "device/gpu/strain_bias.hpp"
#include "device/kernel_pack.hpp"
#include "gl/objects.hpp"
#include "physics/body.glsl"
#include "physics/contact/surface.glsl"
#include "physics/control.glsl"

namespace pliant {
namespace {

// A shader that calls a kernel for each of its items.
struct Caller {
  std::string_view file;
  bool items_are_groups;  // or threads
};
constexpr Caller thread_caller = {"compute/main.comp", false}, group_caller = {"compute/groups.comp", true},
                 force_caller = {"compute/force.comp", true}, round_caller = {"compute/rounds.comp", true};

class LandingTransfer final : public Transfer {
 public:
  explicit LandingTransfer(std::vector<gl::Landing::Source> sources) : sources_(std::move(sources)) {}
  void begin() override { landing_.begin(sources_); }
  bool has_arrived() override { return landing_.has_arrived(); }
  std::span<const std::byte> bytes() const override { return landing_.copied(); }

 private:
  std::vector<gl::Landing::Source> sources_;
  gl::Landing landing_;
};

class GpuDevice final : public Device {
 public:
  GpuDevice(std::unique_ptr<gl::Context> context, ItemOrder order) : GpuDevice(*context, order) {
    own_context_ = std::move(context);
  }
  GpuDevice(gl::Context& context, ItemOrder order) : context_(context), order_(order) {
    const gl::Adapter& adapter = context_.adapter();
    if (adapter.storage_blocks < max_arrays)
      throw Error(ErrorKind::device, adapter.renderer,
                  fmt::format("its driver has {} storage blocks for a compute shader, but pliant needs {}",
                              adapter.storage_blocks, max_arrays),
                  "update the graphics driver, or use --device cpu");
    info_ = {.kind = DeviceKind::gpu,
             .name = adapter.renderer + ", " + adapter.version,
             .threads = 1,
             .free_memory = adapter.free_memory};
    variants_ = gpu::force_variants({.are_software = adapter.is_software, .multiprocessors = adapter.multiprocessors});
  }

  const DeviceInfo& info() const override { return info_; }
  int precision() const override { return 32; }
  gl::Context& context() const { return context_; }
  GLuint gl_buffer(BufferId buffer) const { return storage(buffer).id(); }

  BufferId allocate(std::size_t bytes, std::string_view label, Content content) override {
    gpu::expect_room(bytes, allocated_bytes(), info_.free_memory);
    buffers_.emplace(next_buffer_, content == Content::zeros ? gl::Buffer(bytes, label) : gl::Buffer::unfilled(bytes, label));
    return next_buffer_++;
  }
  void enlarge(BufferId buffer, std::size_t bytes) override {
    gpu::expect_room(bytes, allocated_bytes() - buffers_.at(buffer).size(), info_.free_memory);
    ahead_.clear();
    bound_ = {};
    gl::Buffer& enlarged = buffers_.at(buffer);
    const std::size_t before = enlarged.size();
    enlarged = gl::Buffer();  // so that there is never room needed for both
    try {
      enlarged = gl::Buffer::unfilled(bytes, "enlarged");
    } catch (const Error&) {
      enlarged = gl::Buffer::unfilled(before, "not enlarged");
      throw;
    }
  }
  BufferId part_of(BufferId buffer, std::size_t first_byte, std::size_t bytes) override {
    parts_.emplace(next_buffer_, part(buffer).part(first_byte, bytes));
    return next_buffer_++;
  }
  void release(BufferId buffer) override {
    ahead_.clear();
    buffers_.erase(buffer);
    parts_.erase(buffer);
  }
  std::size_t size_of(BufferId buffer) const override { return part(buffer).size; }
  std::size_t allocated_bytes() const override {
    std::size_t bytes = 0;
    for (const auto& [id, buffer] : buffers_) bytes += buffer.size();
    return bytes;
  }
  void write(BufferId buffer, std::size_t first_byte, std::span<const std::byte> data) override {
    ahead_.clear();
    const BufferPart to = part(buffer);
    buffers_.at(to.whole).write(to.place_of(first_byte, data.size()), data);
  }
  void read(BufferId buffer, std::size_t first_byte, std::span<std::byte> data) override {
    const BufferPart from = part(buffer);
    const std::size_t place = from.place_of(first_byte, data.size());
    if (const auto found = ahead_.find(buffer); found != ahead_.end())
      std::ranges::copy(found->second.subspan(first_byte, data.size()), data.begin());
    else
      storage(from.whole).read(place, data);
  }
  // An H200 takes 30 us to answer, whatever the size.
  void read_ahead(std::span<const BufferId> buffers) override {
    constexpr std::size_t most_bytes = 1 << 20;
    ahead_.clear();
    std::vector<gl::Landing::Source> sources;
    std::size_t bytes = 0;
    for (const BufferId buffer : buffers) {
      const BufferPart from = part(buffer);
      sources.push_back({&storage(from.whole), from.first_byte, from.size});
      bytes += from.size;
    }
    if (bytes > most_bytes) return;
    std::span<const std::byte> copied = landing_.copy(sources);
    for (const BufferId buffer : buffers) {
      ahead_[buffer] = copied.first(size_of(buffer));
      copied = copied.subspan(size_of(buffer));
    }
  }

  std::unique_ptr<Transfer> transfer_from(BufferId buffer, std::vector<ByteRange> parts) override {
    const BufferPart from = part(buffer);
    std::vector<gl::Landing::Source> sources;
    for (const ByteRange& range : parts)
      sources.push_back({&storage(from.whole), from.place_of(range.first, range.count), range.count});
    return std::make_unique<LandingTransfer>(std::move(sources));
  }

  KernelId kernel(std::string_view name) override { return build(name, thread_caller); }
  KernelId group_kernel(std::string_view name, std::uint32_t threads) override {
    return build(fmt::format("{}, {} threads", name, threads), group_caller,
                 defines_of(name, {{"GROUP_THREADS", std::to_string(threads)}}));
  }
  KernelId round_kernel(std::string_view name) override {
    GLint bytes = 0;
    glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &bytes);
    return build(name, round_caller, {{"SHARED_BYTES", fmt::format("{}u", bytes)}});
  }
  std::uint32_t groups_at_once(KernelId round_kernel) override {
    PLIANT_EXPECT(kernels_[round_kernel].caller == &round_caller);
    if (kernels_[round_kernel].groups_at_once == 0) {
      std::uint32_t groups = std::max(shares_at_once(), 1u);
      while (groups > 1 && !all_meet_in_one_of_two_tries(round_kernel, groups)) groups /= 2;
      kernels_[round_kernel].groups_at_once = groups;
    }
    return kernels_[round_kernel].groups_at_once;
  }
  KernelId force_kernel(std::string_view name, std::size_t variant, ForceSpan span) override {
    PLIANT_EXPECT(variant <= variants_.size());
    const gpu::Lanes& lanes = gpu::lanes_of(variant);
    PLIANT_EXPECT(span == ForceSpan::stage || lanes.tile != 0);
    std::vector<gl::Define> defines = {{"@kernel", "compute/kernels/" + std::string(name) + ".glsl"},
                                       {"LANES", std::to_string(lanes.lanes)},
                                       {"VERTICES", std::to_string(lanes.vertices)},
                                       {"TEAMS", std::to_string(lanes.teams)},
                                       {"KEEPERS", std::to_string(lanes.keepers())},
                                       {"UNROLL", std::to_string(lanes.unroll)},
                                       {"PLAINLY", std::to_string(lanes.plainly)}};
    defines.push_back({lanes.lanes == 0 ? "GIVEN_SUMS" : "!GIVEN_SUMS", ""});
    defines.push_back({span == ForceSpan::stage ? "!TILE" : "TILE", std::to_string(lanes.tile)});
    const bool of_impulses = span == ForceSpan::quiet_steps_of_impulses;
    defines.push_back({of_impulses || span == ForceSpan::quiet_steps ? "QUIET" : "!QUIET", ""});
    defines.push_back({of_impulses ? "IMPULSES" : "!IMPULSES", ""});
    constexpr std::string_view names[] = {"a stage", "a step", "quiet steps", "quiet steps of impulses"};
    const ForceVariant& way = variant == variants_.size() ? for_given_sums_ : variants_[variant];
    return build(fmt::format("{}, {}, {}", name, way.name, names[static_cast<std::size_t>(span)]), force_caller, defines);
  }
  const KernelSignature& signature(KernelId kernel) const override { return kernels_[kernel].signature; }
  // Returns the number of multiprocessors. A group of a force kernel runs on each at once, however many registers and how much
  // shared memory it takes.
  std::uint32_t shares_at_once() const override { return context_.adapter().multiprocessors; }
  std::span<const ForceVariant> force_variants() const override { return variants_; }
  const ForceVariant& variant_for_given_sums() const override { return for_given_sums_; }

  double strain_bias() override {
    if (!strain_bias_) strain_bias_ = gpu::measure_strain_bias();
    return *strain_bias_;
  }

  void run(std::span<const Pass> passes) override {
    bound_ = {};  // others may have bound theirs since
    ahead_.clear();
    for (const Pass& pass : passes)
      if (pass.host_work != nullptr)
        run_on_host(*pass.host_work);
      else
        dispatch(pass);
  }
  std::uint32_t parallel_items(std::uint32_t bodies) const override {
    return context_.adapter().is_software ? 256 : threads_for(bodies);
  }
  // tree_search.cpp says why llvmpipe needs more than keep it busy.
  std::uint32_t items_of_lists(std::uint32_t bodies) const override {
    return context_.adapter().is_software ? 4096 : threads_for(bodies);
  }
  void finish() override { glFinish(); }
  void mark_time() override {
    glGenQueries(1, &marks_.emplace_back());
    glQueryCounter(marks_.back(), GL_TIMESTAMP);
  }
  // Waits first. NVIDIA's driver 580 may not have sent the last mark to the GPU yet. Whoever asks for it waits for 11 s then, and
  // after that all buffers hold zeros.
  std::vector<double> take_times() override {
    glFinish();
    std::vector<double> times;
    for (const GLuint mark : marks_) {
      GLuint64 nanoseconds = 0;
      glGetQueryObjectui64v(mark, GL_QUERY_RESULT, &nanoseconds);
      times.push_back(1e-9 * static_cast<double>(nanoseconds));
    }
    glDeleteQueries(static_cast<GLsizei>(marks_.size()), marks_.data());
    marks_.clear();
    return times;
  }

 private:
  struct Kernel {
    std::string name;
    const Caller* caller;
    KernelSignature signature;
    gl::Program program;
    std::vector<std::size_t> bindings;    // of the signature's arrays
    std::vector<bool> parameter_is_used;  // compilers leave out uniforms that a variant has no use for
    std::vector<Parameter> parameters;    // as last set, where uniforms start as zero
    std::uint32_t groups_at_once = 0;     // of a kernel in rounds. 0: not known yet
  };
  // Of the kernel's file and function, of the order of items, and more. Force kernels have no such order.
  std::vector<gl::Define> defines_of(std::string_view name, std::vector<gl::Define> more) const {
    more.insert(more.end(), {{"@kernel", "compute/kernels/" + std::string(name) + ".glsl"},
                             {"KERNEL", std::string(name)},
                             {order_ == ItemOrder::descending ? "DESCENDS" : "!DESCENDS", ""}});
    return more;
  }

  KernelId build(std::string_view name, const Caller& caller, std::vector<gl::Define> defines = {}) {
    return build(std::string(name), caller, defines_of(name, std::move(defines)));
  }

  // Returns the kernel that was built before for the same caller, or builds it.
  KernelId build(const std::string& name, const Caller& caller, const std::vector<gl::Define>& defines) {
    for (std::size_t k = 0; k < kernels_.size(); ++k)
      if (kernels_[k].name == name && kernels_[k].caller == &caller) return static_cast<KernelId>(k);
    gpu::KernelSource source = gpu::kernel_source(files_, caller.file, defines);
    Kernel made{name, &caller, std::move(source.signature), gl::Program::compute(source.shader, name), {}, {}, {}};
    for (std::size_t k = 0; k < made.signature.arrays.size(); ++k)
      made.bindings.push_back(gpu::binding_of(made.signature.arrays, k));
    for (std::size_t slot = 0; slot < made.signature.parameters.size(); ++slot)
      made.parameter_is_used.push_back(has_location(made.program.id(), slot));
    made.parameters.resize(made.signature.parameters.size());
    kernels_.push_back(std::move(made));
    return static_cast<KernelId>(kernels_.size() - 1);
  }

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

  // Has work groups of a kernel in rounds do nothing but wait for each other. Returns whether all met.
  bool all_meet(KernelId round_kernel, std::uint32_t groups) {
    const Kernel& kernel = kernels_[round_kernel];
    constexpr GLint is_rehearsal = 1000;  // in rounds.comp
    const DeviceArray<physics::ContactList> list(*this, 1, "rehearsal");
    Pass pass{.name = kernel.name, .call = {.kernel = round_kernel, .buffers = {}, .parameters = {}}, .item_count = groups};
    pass.call.buffers.resize(kernel.signature.arrays.size(), list.id());  // of which none but the list of contacts is used
    for (const KernelSignature::Number& number : kernel.signature.parameters)
      pass.call.parameters.push_back(number.name == "item_count" ? Parameter(groups) : number.is_double ? Parameter(0.0) : 0u);
    glProgramUniform1ui(kernel.program.id(), is_rehearsal, 1);
    run(std::span(&pass, 1));
    glProgramUniform1ui(kernel.program.id(), is_rehearsal, 0);
    return (list.download().front().arrivals & physics::waited_in_vain) == 0;
  }

  // Another program may be in the way of one.
  bool all_meet_in_one_of_two_tries(KernelId round_kernel, std::uint32_t groups) {
    return all_meet(round_kernel, groups) || all_meet(round_kernel, groups);
  }

  // Of searches and lists. Those of few bodies are short, and threads with nothing to do take time, too.
  static std::uint32_t threads_for(std::uint32_t bodies) { return 65536 * std::clamp(bodies / 16, 1u, 4u); }

  const gl::Buffer& storage(BufferId buffer) const { return buffers_.at(buffer); }
  BufferPart part(BufferId buffer) const {
    const auto found = parts_.find(buffer);
    return found != parts_.end() ? found->second : BufferPart{buffer, 0, storage(buffer).size()};
  }

  // Uploads come before the kernels that follow. What was read ahead before does not hold.
  void run_on_host(HostWork& work) {
    work.run();
    ahead_.clear();
    bound_ = {};
  }

  void dispatch(const Pass& pass) {
    if (pass.item_count == 0) return;
    const std::uint32_t groups =
        kernels_[pass.call.kernel].caller->items_are_groups ? pass.item_count : physics::groups_for(pass.item_count);
    const std::uint32_t rows = (groups + physics::max_groups - 1) / physics::max_groups;
    prepare(pass.call);
    glDispatchCompute(std::min(groups, physics::max_groups), rows, 1);
    if (!pass.beside_next) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

  void bind(std::size_t binding, BufferId buffer) {
    if (bound_[binding] == buffer) return;
    bound_[binding] = buffer;
    const BufferPart at = part(buffer);
    const GLenum target = binding < max_arrays ? GL_SHADER_STORAGE_BUFFER : GL_UNIFORM_BUFFER;
    glBindBufferRange(target, static_cast<GLuint>(binding), gl_buffer(at.whole), static_cast<GLintptr>(at.first_byte),
                      static_cast<GLsizeiptr>(at.size));
  }

  void prepare(const KernelCall& call) {
    Kernel& kernel = kernels_[call.kernel];
    glUseProgram(kernel.program.id());
    for (std::size_t k = 0; k < call.buffers.size(); ++k) bind(kernel.bindings[k], call.buffers[k]);
    for (std::size_t slot = 0; slot < call.parameters.size(); ++slot) set_parameter(kernel, slot, call.parameters[slot]);
  }

  static void set_parameter(Kernel& kernel, std::size_t slot, const Parameter& value) {
    if (!kernel.parameter_is_used[slot] || kernel.parameters[slot] == value) return;
    kernel.parameters[slot] = value;
    const GLint location = static_cast<GLint>(slot);
    if (const auto* number = std::get_if<double>(&value))
      glUniform1d(location, *number);
    else
      glUniform1ui(location, std::get<std::uint32_t>(value));
  }

  std::unique_ptr<gl::Context> own_context_;  // null if it is a window's
  gl::Context& context_;
  ItemOrder order_;
  DeviceInfo info_;
  std::vector<ForceVariant> variants_;
  ForceVariant for_given_sums_ = gpu::variant_for_given_sums();
  std::vector<gl::ShaderFile> files_ = all_shader_files();
  std::vector<GLuint> marks_;
  std::optional<double> strain_bias_;
  std::array<BufferId, max_arrays + max_constants> bound_{};  // by binding
  std::unordered_map<BufferId, gl::Buffer> buffers_;
  std::unordered_map<BufferId, BufferPart> parts_;
  gl::Landing landing_;
  std::unordered_map<BufferId, std::span<const std::byte>> ahead_;  // what landed, of buffers that nothing has written since
  std::vector<Kernel> kernels_;
  BufferId next_buffer_ = 1;
};

}  // namespace

void gpu::expect_room(std::uint64_t bytes, std::uint64_t allocated, std::uint64_t free_memory) {
  if (free_memory == 0 || bytes + allocated <= free_memory) return;
  throw Error(ErrorKind::device, "GPU memory",
              fmt::format("{:.1f} MB were free, and {:.1f} MB are needed at least", 1e-6 * static_cast<double>(free_memory),
                          1e-6 * static_cast<double>(bytes + allocated)),
              "use coarser meshes or --device cpu, or close other programs that use the GPU");
}

std::unique_ptr<Device> make_gpu_device(int index) { return make_gpu_device(index, ItemOrder::ascending); }

std::unique_ptr<Device> make_gpu_device(int index, ItemOrder order) {
  return std::make_unique<GpuDevice>(std::make_unique<gl::Context>(index), order);
}

std::unique_ptr<Device> make_gpu_device(gl::Context& context) {
  return std::make_unique<GpuDevice>(context, ItemOrder::ascending);
}

gl::Context* gpu::context_of(Device& device) {
  auto* gpu = dynamic_cast<GpuDevice*>(&device);
  return gpu == nullptr ? nullptr : &gpu->context();
}

std::uint32_t gpu::gl_buffer_of(Device& device, BufferId buffer) {
  return dynamic_cast<const GpuDevice&>(device).gl_buffer(buffer);
}

}  // namespace pliant
