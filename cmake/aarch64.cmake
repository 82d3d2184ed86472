# Toolchain for 64-bit Arm: Debian's cross-compiler, with the libraries of an arm64 system in FOOTHOLD_SYSROOT. Programs run in QEMU.
# scripts/test_aarch64.sh makes such a system.
set(FOOTHOLD_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../build/aarch64-sysroot CACHE PATH "Root of an arm64 system that has what Foothold needs")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FOOTHOLD_SYSROOT)

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L ${FOOTHOLD_SYSROOT})

set(CMAKE_SYSROOT ${FOOTHOLD_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
