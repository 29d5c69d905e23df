// Lets threads of a subgroup add up together, where a GPU can. A frame whose kernels do so includes it before all else.
#extension GL_KHR_shader_subgroup_basic : enable
#extension GL_KHR_shader_subgroup_arithmetic : enable
#if defined(GL_KHR_shader_subgroup_basic) && defined(GL_KHR_shader_subgroup_arithmetic)
#define HAS_SUBGROUPS
#endif
