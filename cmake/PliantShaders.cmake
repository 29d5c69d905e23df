# Puts every shader file into the library, so that the program runs from anywhere.
function(pliant_embed_shaders target)
  set(shader_dir ${PROJECT_SOURCE_DIR}/shaders)
  file(GLOB_RECURSE shader_files CONFIGURE_DEPENDS ${shader_dir}/*.glsl ${shader_dir}/*.comp
                                                   ${shader_dir}/*.vert ${shader_dir}/*.frag)
  set(embedded ${PROJECT_BINARY_DIR}/embedded_shaders.cpp)
  add_custom_command(OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${embedded} -DSHADER_DIR=${shader_dir} -P ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    DEPENDS ${shader_files} ${PROJECT_SOURCE_DIR}/cmake/embed_shaders.cmake
    COMMENT "Embedding the shaders" VERBATIM)
  target_sources(${target} PRIVATE ${embedded})
endfunction()
