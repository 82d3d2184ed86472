# Run by CTest; see CMakeLists.txt. Every step must succeed, without OpenCV, OpenNI2 or any library of the apps to be found.

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(disabled)
foreach(package OpenCV OpenNI2 nlohmann_json CLI11 Catch2)
  list(APPEND disabled -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

file(REMOVE_RECURSE ${SCRATCH}/prefix ${SCRATCH}/build)
run(${CMAKE_COMMAND} --install ${FOOTHOLD_BUILD} --prefix ${SCRATCH}/prefix)
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${SCRATCH}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
  -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=Release ${disabled})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
foreach(program tracker camera)
  if(EXISTS ${SCRATCH}/build/${program})
    run(${CMAKE_COMMAND} -E chdir ${SCRATCH}/build ${SCRATCH}/build/${program})
    message(STATUS "${output}")
  endif()
endforeach()
