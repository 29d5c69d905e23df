# The Python package `pliant`: python/pliant, and the module _core that it has of the library. It is optional. Debian: pybind11-dev,
# python3-dev, python3-numpy. In the build folder it stands in python/, for PYTHONPATH.
set(PLIANT_PYTHON AUTO CACHE STRING "Build the Python package, which needs pybind11: ON, OFF, or AUTO (at the top level, where it is found)")

# Debian's packages are for Debian's Python. Another one that comes first in PATH would not see them.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
set(python_is_built ${PLIANT_PYTHON})
if(PLIANT_PYTHON STREQUAL "AUTO")
  set(python_is_built ${PROJECT_IS_TOP_LEVEL})
  if(PLIANT_SANITIZE)
    set(python_is_built OFF)  # Python itself has no sanitizers
  endif()
endif()
if(python_is_built)
  find_package(Python3 3.11 QUIET COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 QUIET)
  if(NOT Python3_Development.Module_FOUND OR NOT pybind11_FOUND)
    set(python_is_built OFF)
    set(message_kind STATUS)
    if(NOT PLIANT_PYTHON STREQUAL "AUTO")
      set(message_kind FATAL_ERROR)
    endif()
    message(${message_kind} "Without the Python package: it needs Python 3.11 and pybind11 2.10 (Debian: python3-dev, pybind11-dev)")
  endif()
endif()

set(PLIANT_PYTHON_DIR "" CACHE STRING "Folder below the prefix in which the Python package is installed; empty: where that Python looks")
set(python_dir ${PLIANT_PYTHON_DIR})
if(NOT python_dir AND EXISTS /etc/debian_version AND (NOT Python3_EXECUTABLE OR Python3_EXECUTABLE STREQUAL "/usr/bin/python3"))
  set(python_dir lib/python3/dist-packages)  # where Debian's Python looks below /usr
elseif(NOT python_dir AND Python3_VERSION)
  set(python_dir lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)
endif()

if(python_is_built)
  file(GLOB core_sources CONFIGURE_DEPENDS src/python/*.cpp)
  python3_add_library(pliant_core MODULE WITH_SOABI ${core_sources})
  target_link_libraries(pliant_core PRIVATE pliant pybind11::headers fmt::fmt)
  set_target_properties(pliant_core PROPERTIES OUTPUT_NAME _core CXX_VISIBILITY_PRESET hidden
                                               LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/pliant)
  pliant_compile_options(pliant_core)
  target_compile_options(pliant_core PRIVATE $<$<CONFIG:Release>:-O2>)
  pliant_unite_folders(pliant_core)
  file(GLOB_RECURSE package_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/python python/pliant/*.py python/pliant/*.pyi
                                                    python/pliant/py.typed)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python/pliant)
  foreach(file IN LISTS package_files)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/${file} ${PROJECT_BINARY_DIR}/python/${file} SYMBOLIC)
  endforeach()
endif()
