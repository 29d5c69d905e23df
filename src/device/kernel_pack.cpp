#include "device/kernel_pack.hpp"

namespace pliant {
namespace {

std::vector<KernelPack>& packs() {
  static std::vector<KernelPack> all;
  return all;
}

template <class Row>
void append(std::vector<Row>& to, std::span<const Row> more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

void add_kernels(const KernelPack& pack) { packs().push_back(pack); }

std::vector<gl::ShaderFile> all_shader_files() {
  std::vector<gl::ShaderFile> files;
  append(files, gl::embedded_shaders());
  for (const KernelPack& pack : packs()) append(files, pack.files);
  return files;
}

std::vector<cpu::KernelEntry> all_kernels_on_cpu(int precision) {
  std::vector<cpu::KernelEntry> entries;
  append(entries, precision == 64 ? cpu::kernels_64() : cpu::kernels_32());
  for (const KernelPack& pack : packs()) append(entries, precision == 64 ? pack.on_cpu_64 : pack.on_cpu_32);
  return entries;
}

}  // namespace pliant
