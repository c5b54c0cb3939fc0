# SPDX-License-Identifier: BSD-3-Clause
# Compiler settings shared by every target: standard, warnings, hardening, sanitizers, ccache.
option(BUILD_TESTING "Build the tests" ON)
option(HOCTOMAP_WERROR "Treat warnings as errors" OFF)
option(HOCTOMAP_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(HOCTOMAP_SANITIZE_THREADS "Build with ThreadSanitizer" OFF)
option(HOCTOMAP_PYTHON "Build the Python module" OFF)
option(HOCTOMAP_FUZZ "Build the targets of tests/fuzz for libFuzzer, too; needs clang" OFF)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Target `all_verify_interface_header_sets` compiles every public header by itself, without what is precompiled.
set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)

find_program(HOCTOMAP_CCACHE ccache)
if(HOCTOMAP_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without these ccache does not store what is compiled with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${HOCTOMAP_CCACHE}")
endif()

# Lines in stack traces and profiles; what -g writes beyond takes a quarter of the compile time.
string(REGEX REPLACE "(^| )-g( |$)" "\\1-g1\\2" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")

add_library(hoctomap_flags INTERFACE)
target_compile_options(hoctomap_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond>
  # The octree update is bit-exact with stock OctoMap only without fused multiply-add.
  -ffp-contract=off
  -fstack-protector-strong)
target_link_options(hoctomap_flags INTERFACE -Wl,-z,relro,-z,now -Wl,--as-needed)
if(HOCTOMAP_WERROR)
  target_compile_options(hoctomap_flags INTERFACE -Werror)
endif()
if(HOCTOMAP_FUZZ)
  target_compile_options(hoctomap_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(HOCTOMAP_SANITIZE OR HOCTOMAP_SANITIZE_THREADS)
  # No limits on address space, of which a sanitizer maps terabytes, and no allocation functions of our own.
  target_compile_definitions(hoctomap_flags INTERFACE HOCTOMAP_SANITIZED)
endif()
if(HOCTOMAP_SANITIZE)
  target_compile_options(hoctomap_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
    # GCC 12 reports false null dereferences in sanitized code.
    -Wno-null-dereference)
  target_link_options(hoctomap_flags INTERFACE -fsanitize=address,undefined)
elseif(HOCTOMAP_SANITIZE_THREADS)
  target_compile_options(hoctomap_flags INTERFACE
    -fsanitize=thread -fno-omit-frame-pointer -Wno-null-dereference $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
  target_link_options(hoctomap_flags INTERFACE -fsanitize=thread)
else()
  target_compile_options(hoctomap_flags INTERFACE
    $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE$<SEMICOLON>-D_FORTIFY_SOURCE=2>)
endif()
