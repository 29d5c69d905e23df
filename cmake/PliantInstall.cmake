# The library as a package: find_package(pliant), target pliant::pliant; the program, and the Python package. The tree may be moved.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pliant)

if(TARGET pliant_app)
  install(TARGETS pliant_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  install(DIRECTORY scenes/demos DESTINATION share/pliant/scenes COMPONENT program)  # the viewer's start page looks there
  install(FILES meshes/bunny.obj meshes/teapot.obj meshes/README.md DESTINATION share/pliant/meshes COMPONENT program)
endif()

if(python_is_built)
  install(TARGETS pliant_core LIBRARY DESTINATION ${python_dir}/pliant COMPONENT python)
  install(DIRECTORY python/pliant DESTINATION ${python_dir} COMPONENT python PATTERN "__pycache__" EXCLUDE)
endif()

# Headers include each other from src/ and from shaders/compute/.
install(TARGETS pliant EXPORT pliant_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(EXPORT pliant_targets NAMESPACE pliant:: DESTINATION ${package_dir} COMPONENT library)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pliant COMPONENT library
        FILES_MATCHING PATTERN "*.hpp" PATTERN "kernel_prelude.inc"
        PATTERN "app" EXCLUDE PATTERN "bench" EXCLUDE PATTERN "python" EXCLUDE PATTERN "window" EXCLUDE
        PATTERN "studio.hpp" EXCLUDE PATTERN "scene/toml.hpp" EXCLUDE PATTERN "scene/overrides.hpp" EXCLUDE)
install(DIRECTORY shaders/compute/physics DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pliant/shaders COMPONENT library)
install(DIRECTORY shaders/compute/kernels/parts DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pliant/shaders/kernels
        COMPONENT library)  # for kernels from outside
configure_package_config_file(cmake/pliantConfig.cmake.in ${PROJECT_BINARY_DIR}/pliantConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pliantConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pliantConfig.cmake ${PROJECT_BINARY_DIR}/pliantConfigVersion.cmake DESTINATION ${package_dir}
        COMPONENT library)

include(PliantPackages)
