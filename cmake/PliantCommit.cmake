# Writes the commit of every build to a header of its own, pliant_commit.hpp: PLIANT_COMMIT, with "-dirty" behind it where files differ
# from the commit, "unknown" outside a git checkout. At every build, as a benchmark must not carry the name of an earlier commit.
function(pliant_write_commit target)
  set(header ${PROJECT_BINARY_DIR}/commit/pliant_commit.hpp)
  add_custom_target(${target}_commit
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${header} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake
    BYPRODUCTS ${header} VERBATIM)
  add_dependencies(${target} ${target}_commit)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/commit)
endfunction()
