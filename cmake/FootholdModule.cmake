# How modules, apps and tests are declared. One place for every compiler flag.

add_library(foothold_flags INTERFACE)
target_compile_options(foothold_flags INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion>
  # Results must not depend on whether a compiler fuses a multiplication with an addition: bodies that want it say std::fma.
  $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off -fno-math-errno -fno-trapping-math>
  $<$<COMPILE_LANGUAGE:CUDA>:--fmad=false --expt-relaxed-constexpr -diag-suppress=20012 -Xcompiler=-Wall,-Wextra,-ffp-contract=off>)
if(FOOTHOLD_CPU)
  target_compile_options(foothold_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-march=${FOOTHOLD_CPU}>)
endif()
if(FOOTHOLD_WERROR)
  target_compile_options(foothold_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror> $<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings -Xcompiler=-Werror>)
endif()
if(FOOTHOLD_SANITIZE)
  target_compile_options(foothold_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${FOOTHOLD_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all>)
  target_link_options(foothold_flags INTERFACE -fsanitize=${FOOTHOLD_SANITIZE})
endif()

# foothold_group_sources(<sources> <dispatching sources>): which sources a unity build compiles as one: eight at a time, and apart from them
# those that choose between devices, since tests with a device of their own replace the objects of the latter.
function(foothold_group_sources sources dispatching)
  set(index 0)
  foreach(source ${sources})
    math(EXPR group "${index} / 8")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP sources_${group})
    math(EXPR index "${index} + 1")
  endforeach()
  set_source_files_properties(${dispatching} PROPERTIES UNITY_GROUP dispatching)
endfunction()

# foothold_module(<name> [SOURCES ...] [DISPATCHING_SOURCES ...] [CUDA_SOURCES ...] [PUBLIC ...] [PRIVATE ...])
#
# A library foothold_<name>, alias foothold::<name>, with its public headers in include/ and its private ones in src/.
# DISPATCHING_SOURCES choose between devices; the library's property of that name holds their paths, for tests that compile them for a device
# of their own. CUDA_SOURCES are added where the build has CUDA. A module without sources is header-only.
function(foothold_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;DISPATCHING_SOURCES;CUDA_SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target foothold_${name})
  if(arg_SOURCES)
    add_library(${target} ${arg_SOURCES} ${arg_DISPATCHING_SOURCES})
    list(TRANSFORM arg_DISPATCHING_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    set_target_properties(${target} PROPERTIES DISPATCHING_SOURCES "${arg_DISPATCHING_SOURCES}")
    foothold_group_sources("${arg_SOURCES}" "${arg_DISPATCHING_SOURCES}")
    set(scope PUBLIC)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${FOOTHOLD_UNITY} UNITY_BUILD_MODE GROUP)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:foothold_flags>)
    target_include_directories(${target} PRIVATE src)
    if(FOOTHOLD_HAS_CUDA AND arg_CUDA_SOURCES)
      target_sources(${target} PRIVATE ${arg_CUDA_SOURCES})
      target_compile_definitions(${target} PRIVATE FOOTHOLD_HAS_CUDA)
      target_link_libraries(${target} PUBLIC CUDA::cudart_static)
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(foothold::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_compile_features(${target} ${scope} cxx_std_17)
  target_link_libraries(${target} ${scope} ${arg_PUBLIC})
  if(arg_PRIVATE)
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE})
  endif()
  set_property(GLOBAL APPEND PROPERTY FOOTHOLD_MODULES ${name})

  # For its install: the modules that it links.
  set(needed ${arg_PUBLIC} ${arg_PRIVATE})
  list(FILTER needed INCLUDE REGEX "^foothold::")
  list(TRANSFORM needed REPLACE "^foothold::" "")
  set_property(GLOBAL PROPERTY FOOTHOLD_${name}_NEEDS ${needed})
endfunction()

# foothold_app(<name> SOURCES ... [LIBRARIES ...]): an executable in bin/.
function(foothold_app name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${FOOTHOLD_UNITY})
  target_link_libraries(${name} PRIVATE foothold_flags ${arg_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY FOOTHOLD_APPS ${name})
endfunction()

# foothold_build_as_test(<target>): how programs of tests are compiled. Most of their code runs once: optimising it costs more than it saves.
function(foothold_build_as_test target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FOOTHOLD_UNITY})
  target_link_libraries(${target} PRIVATE foothold_flags)
  target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<NOT:$<CONFIG:Debug>>>:-O1>)
endfunction()

# foothold_test(<module> SOURCES ... [LIBRARIES ...] [PROPERTIES ...])
#
# An executable foothold_<module>_tests whose Catch2 test cases become CTest tests. It may see the module's private headers. PROPERTIES are those
# of each CTest test, as set_tests_properties() takes them.
function(foothold_test module)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;PROPERTIES" ${ARGN})
  set(target foothold_${module}_tests)
  add_executable(${target} ${arg_SOURCES})
  foothold_build_as_test(${target})
  target_link_libraries(${target} PRIVATE foothold_test_support foothold::${module} ${arg_LIBRARIES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/modules/${module}/src)
  catch_discover_tests(${target} TEST_PREFIX "${module}/" DISCOVERY_MODE PRE_TEST PROPERTIES ${arg_PROPERTIES})
endfunction()
