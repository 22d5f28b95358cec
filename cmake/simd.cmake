# SPDX-License-Identifier: GPL-3.0-or-later
# plyform_simd_kernel(NAME): NAME_generic.cpp and NAME_avx2.cpp of the calling folder, and
# NAME_avx512.cpp if there is one, hold the copies of a kernel that base/simd.hpp speaks of.
# Only they get flags of their own. On other processors than x86 all are compiled alike and the first
# is used.
function(plyform_simd_kernel name)
  # nothing reads errno or changes the rounding (which CGAL asks for); the vectors stay inside
  set(options -fno-math-errno -fno-rounding-math -Wno-psabi)
  set(generic "")
  set(avx2 -mavx2)
  # kernels say themselves where vectors hold eight numbers (PLYFORM_LANES), not the compiler
  set(avx512 -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=256)
  foreach(copy generic avx2 avx512)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}_${copy}.cpp)
      continue()
    endif()
    set(flags ${options})
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      list(APPEND flags ${${copy}})
    endif()
    # precompiled headers are compiled without these flags, and kernels include none of them
    set_source_files_properties(${name}_${copy}.cpp PROPERTIES COMPILE_OPTIONS "${flags}"
                                SKIP_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
