# SPDX-License-Identifier: GPL-3.0-or-later
# plyform_simd_kernel(NAME): NAME_generic.cpp and NAME_avx2.cpp of the calling folder hold the two copies
# of a kernel that contact/simd/simd.hpp speaks of. Only they get flags of their own. On other
# processors than x86 both are compiled alike and the first is used.
function(plyform_simd_kernel name)
  # nothing reads errno or changes the rounding (which CGAL asks for); the vectors stay inside
  set(options -fno-math-errno -fno-rounding-math -Wno-psabi)
  set_source_files_properties(${name}_generic.cpp PROPERTIES COMPILE_OPTIONS "${options}")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND options -mavx2)
  endif()
  set_source_files_properties(${name}_avx2.cpp PROPERTIES COMPILE_OPTIONS "${options}")
  # precompiled headers are compiled without these flags, and kernels include none of them
  set_source_files_properties(${name}_generic.cpp ${name}_avx2.cpp PROPERTIES
                              SKIP_PRECOMPILE_HEADERS ON)
endfunction()
