# find_package(foothold): static libraries, headers and a package file that asks for Eigen, oneTBB and, where built with it, CUDA.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY FOOTHOLD_MODULES)
foreach(module ${modules})
  install(TARGETS foothold_${module} EXPORT foothold_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY modules/${module}/include/foothold DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
get_property(apps GLOBAL PROPERTY FOOTHOLD_APPS)
if(apps)
  install(TARGETS ${apps} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(EXPORT foothold_targets NAMESPACE foothold:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/foothold)
configure_package_config_file(cmake/footholdConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/footholdConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/foothold)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/footholdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/footholdConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/footholdConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/foothold)
