// One thread computes the strain of one spring, by whatever roots and quotients this GPU has. strain_bias.cpp compares it with fp64.
#version 450
#include "physics/language.glsl"
#include "physics/forces/spring.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Springs { vec4 spring[]; };  // [spring][2]: x, d
layout(std430, binding = 1) writeonly buffer Strains { float strain[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  strain[i] = spring_strain(spring[2u * i].xyz, spring[2u * i + 1u].xyz);
}
