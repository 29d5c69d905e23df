// GPUs approximate square roots and quotients, and the errors have a bias. On an H200 strains come out too large by 6e-9 of
// themselves. That is a tenth of a rounding, but it is the same in every step and changes all frequencies. Forces are divided by
// one plus this bias.
#pragma once

namespace pliant::gpu {

/// Returns the relative error of physics/forces/spring.glsl in fp32 on the current OpenGL context. It is an average over springs
/// between points of a ball, so that single roundings cancel to some 1e-10. Throws Error (device).
[[nodiscard]] double measure_strain_bias();

}  // namespace pliant::gpu
