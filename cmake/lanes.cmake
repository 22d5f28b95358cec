# SPDX-License-Identifier: GPL-3.0-or-later
# plyform_lane_kernel(NAME): NAME_any.cpp and NAME_avx2.cpp of the calling folder hold the two copies
# of a kernel that contact/lanes.hpp speaks of. Only they get flags of their own. On other
# processors than x86 both are compiled alike and the first is used.
function(plyform_lane_kernel name)
  set(options -fno-math-errno -Wno-psabi) # nothing reads errno; the vectors stay inside the file
  set_source_files_properties(${name}_any.cpp PROPERTIES COMPILE_OPTIONS "${options}")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND options -mavx2)
  endif()
  set_source_files_properties(${name}_avx2.cpp PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
