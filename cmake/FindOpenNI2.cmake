# Finds OpenNI2. Debian ships no CMake package, only pkg-config.
#
# Defines OpenNI2_FOUND and the target OpenNI2::OpenNI2.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_OpenNI2 QUIET libopenni2)
endif()
find_path(OpenNI2_INCLUDE_DIR OpenNI.h HINTS ${PC_OpenNI2_INCLUDE_DIRS} PATH_SUFFIXES openni2)
find_library(OpenNI2_LIBRARY OpenNI2 HINTS ${PC_OpenNI2_LIBRARY_DIRS})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenNI2 REQUIRED_VARS OpenNI2_LIBRARY OpenNI2_INCLUDE_DIR)
mark_as_advanced(OpenNI2_INCLUDE_DIR OpenNI2_LIBRARY)
if(OpenNI2_FOUND AND NOT TARGET OpenNI2::OpenNI2)
  add_library(OpenNI2::OpenNI2 UNKNOWN IMPORTED)
  set_target_properties(OpenNI2::OpenNI2 PROPERTIES IMPORTED_LOCATION ${OpenNI2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OpenNI2_INCLUDE_DIR})
endif()
