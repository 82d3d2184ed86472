#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Packs what a GPU machine without packages and network needs besides CMake, Ninja, a C++ compiler and nvcc: Eigen, oneTBB and Catch2.
#
#   scripts/pack_gpu_deps.sh [ARCHIVE]      default: build/foothold_gpu_deps.tar.gz
#
# Run it on a machine that builds Foothold, of the same processor family. Carry the archive over, unpack it, and name the folder in
# FOOTHOLD_DEPS when you run scripts/test_gpu.sh or scripts/bench_gpu.sh there.
set -euo pipefail
cd "$(dirname "$0")/.."

archive=${1:-build/foothold_gpu_deps.tar.gz}
mkdir -p "$(dirname "$archive")"
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
deps=$staging/foothold_gpu_deps

# Asks CMake where the packages are, as the build would.
cat >"$staging/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(where LANGUAGES CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(Catch2 REQUIRED)
get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
get_target_property(catch Catch2::Catch2 INTERFACE_INCLUDE_DIRECTORIES)
get_target_property(tbb TBB::tbb INTERFACE_INCLUDE_DIRECTORIES)
foreach(configuration RELEASE NONE RELWITHDEBINFO)
  get_target_property(library TBB::tbb IMPORTED_LOCATION_${configuration})
  if(library)
    break()
  endif()
endforeach()
if(NOT EXISTS "${library}")
  message(FATAL_ERROR "TBB::tbb names no library")
endif()
list(GET catch 0 catch)
file(WRITE ${CMAKE_BINARY_DIR}/places "eigen=${eigen}\ntbb=${tbb}\ncatch=${catch}\nlibrary=${library}\ncatch_dir=${Catch2_DIR}\n")
CMAKE
cmake -S "$staging" -B "$staging/build" >"$staging/log" 2>&1 || { cat "$staging/log" >&2; exit 1; }
place() { sed -n "s/^$1=//p" "$staging/build/places"; }

mkdir -p "$deps/include" "$deps/lib/cmake/Eigen3" "$deps/lib/cmake/TBB" "$deps/lib/cmake/Catch2"
cp -rL "$(place eigen)/Eigen" "$(place eigen)/unsupported" "$deps/include/"
cp -rL "$(place tbb)/tbb" "$(place tbb)/oneapi" "$deps/include/"
cp -rL "$(place catch)/catch2" "$deps/include/"
library=$(place library)
cp -L "$library" "$deps/lib/libtbb.so.12"
ln -s libtbb.so.12 "$deps/lib/libtbb.so"
# Catch2's own script that turns test cases into CTest tests, and in version 3 its compiled library.
cp -L "$(place catch_dir)"/Catch*.cmake "$deps/lib/cmake/Catch2/" 2>/dev/null || true
cp -L "$(dirname "$(place catch)")"/lib*/libCatch2*.a "$(dirname "$(place catch)")"/lib/*/libCatch2*.a "$deps/lib/" 2>/dev/null || true

cat >"$deps/lib/cmake/Eigen3/Eigen3Config.cmake" <<'CMAKE'
get_filename_component(prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET Eigen3::Eigen)
  add_library(Eigen3::Eigen INTERFACE IMPORTED)
  set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${prefix}/include")
endif()
CMAKE
cat >"$deps/lib/cmake/Eigen3/Eigen3ConfigVersion.cmake" <<'CMAKE'
set(PACKAGE_VERSION 3.4.0)
set(PACKAGE_VERSION_COMPATIBLE TRUE)
CMAKE
cat >"$deps/lib/cmake/TBB/TBBConfig.cmake" <<'CMAKE'
get_filename_component(prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET TBB::tbb)
  find_package(Threads REQUIRED)
  add_library(TBB::tbb SHARED IMPORTED)
  set_target_properties(TBB::tbb PROPERTIES IMPORTED_LOCATION "${prefix}/lib/libtbb.so.12" INTERFACE_INCLUDE_DIRECTORIES "${prefix}/include"
    INTERFACE_LINK_LIBRARIES Threads::Threads)
endif()
CMAKE
cat >"$deps/lib/cmake/Catch2/Catch2Config.cmake" <<'CMAKE'
get_filename_component(prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
if(NOT TARGET Catch2::Catch2)
  add_library(Catch2::Catch2 INTERFACE IMPORTED)
  set_target_properties(Catch2::Catch2 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${prefix}/include")
  if(EXISTS "${prefix}/lib/libCatch2.a")
    target_link_libraries(Catch2::Catch2 INTERFACE "${prefix}/lib/libCatch2.a")
  endif()
endif()
CMAKE
cat >"$deps/README" <<'TEXT'
Eigen (MPL 2.0), oneTBB (Apache 2.0) and Catch2 (BSL 1.0), repacked by Foothold's scripts/pack_gpu_deps.sh.
Use: FOOTHOLD_DEPS=<this folder> scripts/test_gpu.sh
TEXT
tar -C "$staging" -czf "$archive" foothold_gpu_deps
echo "packed $(du -h "$archive" | cut -f1) into $archive"
