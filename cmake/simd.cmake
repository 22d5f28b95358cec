# SPDX-License-Identifier: GPL-3.0-or-later
# plyform_simd_kernels(TARGET FILE... [COPIES COPY...]): compiles each file once a copy of the kernel
# that base/simd.hpp speaks of (generic, avx2 and avx512 unless told), and links all to TARGET. Only
# they get flags of their own. On other processors than x86 all are compiled alike and the first is
# used.
function(plyform_simd_kernels target)
  cmake_parse_arguments(PARSE_ARGV 1 kernel "" "" "COPIES")
  if(NOT kernel_COPIES)
    set(kernel_COPIES generic avx2 avx512)
  endif()
  set(generic "")
  set(avx2 -mavx2)
  # kernels say themselves where vectors hold eight numbers (PLYFORM_LANES), not the compiler
  set(avx512 -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=256)
  foreach(copy ${kernel_COPIES})
    set(objects ${target}_${copy})
    add_library(${objects} OBJECT ${kernel_UNPARSED_ARGUMENTS})
    set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
    target_include_directories(${objects} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${objects} PRIVATE plyform_options)
    target_compile_definitions(${objects} PRIVATE PLYFORM_COPY=${copy})
    if("${copy}" STREQUAL "avx512") # quoted: a variable has this name
      target_compile_definitions(${objects} PRIVATE PLYFORM_LANES=8)
    endif()
    # nothing reads errno or changes the rounding (which CGAL asks for); the vectors stay inside
    target_compile_options(${objects} PRIVATE -fno-math-errno -fno-rounding-math -Wno-psabi)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      target_compile_options(${objects} PRIVATE ${${copy}})
    endif()
    # With sanitizers the copy for AVX2 is what runs: base/simd.hpp has no AVX-512 there.
    if(PLYFORM_SANITIZE AND NOT "${copy}" STREQUAL "avx2" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      target_compile_options(${objects} PRIVATE -fno-sanitize=all -O0)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
