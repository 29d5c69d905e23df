# Script: writes OUTPUT, a C++ file that defines pliant::gl::embedded_shaders() from every file under SHADER_DIR.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE names RELATIVE ${SHADER_DIR} ${SHADER_DIR}/*.glsl ${SHADER_DIR}/*.comp
                                               ${SHADER_DIR}/*.vert ${SHADER_DIR}/*.frag)
list(SORT names)
set(code "#include \"gl/shader_source.hpp\"\nnamespace pliant::gl {\nstd::span<const ShaderFile> embedded_shaders() {\n")
string(APPEND code "  static constexpr ShaderFile files[] = {\n")
foreach(name IN LISTS names)
  file(READ ${SHADER_DIR}/${name} text)
  string(APPEND code "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
string(APPEND code "  };\n  return files;\n}\n}  // namespace pliant::gl\n")
file(WRITE ${OUTPUT} "${code}")
