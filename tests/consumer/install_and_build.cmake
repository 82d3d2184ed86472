# Run by CTest; see CMakeLists.txt. Every step must succeed, without any package to be found that the component does not need.

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(disabled OpenNI2 nlohmann_json CLI11 Catch2)
if(NOT COMPONENT STREQUAL "io")
  list(APPEND disabled OpenCV ZLIB)
endif()
list(TRANSFORM disabled REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
set(configure ${CMAKE_COMMAND} -S ${PROJECT} -B ${SCRATCH}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=Release ${disabled})

function(build_and_run)
  run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
  foreach(program tracker camera mesh_copy)
    if(EXISTS ${SCRATCH}/build/${program})
      run(${CMAKE_COMMAND} -E chdir ${SCRATCH}/build ${SCRATCH}/build/${program})
      message(STATUS "${output}")
    endif()
  endforeach()
endfunction()

# The component with what it needs, and nothing else.
file(REMOVE_RECURSE ${SCRATCH}/prefix ${SCRATCH}/build)
run(${CMAKE_COMMAND} --install ${FOOTHOLD_BUILD} --prefix ${SCRATCH}/prefix --component ${COMPONENT})
file(GLOB_RECURSE libraries ${SCRATCH}/prefix/*.a)
list(TRANSFORM libraries REPLACE ".*/libfoothold_(.+)\\.a" "\\1")
list(SORT libraries)
if(NOT libraries STREQUAL MODULES)
  message(FATAL_ERROR "component ${COMPONENT} installed the libraries of '${libraries}'; expected '${MODULES}'")
endif()
run(${configure} -DCOMPONENTS=${COMPONENT})
build_and_run()

# What is not installed is named, and where it was looked for.
execute_process(COMMAND ${configure} -DCOMPONENTS=fusion RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "component fusion is not installed in[ \n]+${SCRATCH}/prefix/")
  message(FATAL_ERROR "asking for component fusion, which is not installed, said:\n${output}")
endif()

# Everything, in the same place; asked for without a name, it needs no package of io.
run(${CMAKE_COMMAND} --install ${FOOTHOLD_BUILD} --prefix ${SCRATCH}/prefix)
if(COMPONENT STREQUAL "io")
  run(${configure} -DCOMPONENTS=io)
else()
  run(${configure} -DCOMPONENTS=)
endif()
build_and_run()
