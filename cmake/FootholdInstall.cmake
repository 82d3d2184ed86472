# find_package(foothold): static libraries, headers and a package file that asks for Eigen, oneTBB and, where built with it, CUDA.
#
# Each module is a component of its name: 'cmake --install BUILD --component MODULE' installs it with the modules that it needs, and nothing else
# has to be built. The programs are the component 'apps'.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/foothold)
get_property(modules GLOBAL PROPERTY FOOTHOLD_MODULES)
foreach(module ${modules})
  install(TARGETS foothold_${module} EXPORT foothold_${module} COMPONENT ${module}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY modules/${module}/include/foothold DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${module})
  install(EXPORT foothold_${module} NAMESPACE foothold:: DESTINATION ${package_dir} COMPONENT ${module})
  # What it needs, which in turn installs what that needs. An install of everything has them already.
  get_property(needed GLOBAL PROPERTY FOOTHOLD_${module}_NEEDS)
  foreach(other ${needed})
    install(CODE "
      execute_process(COMMAND \"\${CMAKE_COMMAND}\" --install \"${CMAKE_BINARY_DIR}\" --prefix \"\${CMAKE_INSTALL_PREFIX}\" --component ${other}
        COMMAND_ERROR_IS_FATAL ANY)"
      COMPONENT ${module} EXCLUDE_FROM_ALL)
  endforeach()
endforeach()
get_property(apps GLOBAL PROPERTY FOOTHOLD_APPS)
if(apps)
  install(TARGETS ${apps} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT apps)
endif()

configure_package_config_file(cmake/footholdConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/footholdConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/footholdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/footholdConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/footholdConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT base)
