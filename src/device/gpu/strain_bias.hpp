// GPUs approximate square roots and quotients, and not without bias: on an H200 strains come out 6e-9 of themselves too large.
// That is a tenth of a rounding, but the same in every step, so that it changes all frequencies. Forces are divided by it.
#pragma once

namespace pliant::gpu {

/// The relative error of physics/forces/spring.glsl in fp32 on the current OpenGL context, averaged over springs between points
/// of a ball, so that single roundings cancel to some 1e-10. Throws Error (device).
[[nodiscard]] double measure_strain_bias();

}  // namespace pliant::gpu
