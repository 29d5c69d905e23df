# Warnings, sanitizers and floating-point rules, the same for every target.
function(pliant_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<BOOL:${PLIANT_WARNINGS_AS_ERRORS}>:-Werror>
    # The CPU must make the bits that the shaders make: no fused multiply-add, no reassociation.
    -ffp-contract=off -fno-math-errno -fno-trapping-math)
endfunction()

# For code that nothing waits for, such as reading a command line: it compiles in half the time.
function(pliant_optimize_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
endfunction()

# Most of what a file costs to compile are these headers: they are compiled once. A file still includes what it uses, and a build with
# CMAKE_DISABLE_PRECOMPILE_HEADERS shows whether it does.
set(pliant_common_headers <algorithm> <array> <chrono> <cmath> <cstdint> <cstdio> <filesystem> <fstream> <functional> <limits> <map>
    <memory> <optional> <set> <span> <string> <string_view> <thread> <utility> <variant> <vector>
    <fmt/format.h> <glm/common.hpp> <glm/geometric.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>)
function(pliant_precompile_headers target)
  if(NOT TARGET pliant_precompiled)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
    add_library(pliant_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(pliant_precompiled PRIVATE fmt::fmt glm::glm)
    pliant_compile_options(pliant_precompiled)
    target_precompile_headers(pliant_precompiled PRIVATE ${pliant_common_headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM pliant_precompiled)
endfunction()

# Compiles the files of a folder as one, in about half the time: they share headers and what templates become. An argument such as
# "scene|run" joins folders of src/ or tests/, with what is below them. So names outside of classes differ among files that are joined,
# also those in anonymous namespaces. Files that have options or a precision of their own stay alone.
option(PLIANT_UNITE_FOLDERS "Compile the files of a folder together: half the time for all of it, more for a change of one file" OFF)
function(pliant_unite_folders target)
  if(NOT PLIANT_UNITE_FOLDERS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    foreach(joined IN LISTS ARGN)
      string(REGEX REPLACE "^(src|tests)/(${joined})(/.*)?$" "${joined}" folder "${folder}")
    endforeach()
    string(MAKE_C_IDENTIFIER "${folder}" group)
    file(STRINGS ${source} precision REGEX "#define REAL_BITS")
    if(NOT precision)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # which is about headers, and takes a united .cpp file for one
endfunction()

if(PLIANT_SANITIZE)
  add_compile_options(-fsanitize=${PLIANT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_compile_options(-Wno-maybe-uninitialized)  # gcc 12 misreads the sanitizers' own code in <functional> and <regex>
  add_link_options(-fsanitize=${PLIANT_SANITIZE})
endif()
