# SPDX-License-Identifier: GPL-3.0-or-later
# Where ccache is installed, what was compiled before from the same text is not compiled again, also
# in another clone: paths inside the clone count relative to its root. -DPLYFORM_CCACHE=OFF: compile.
option(PLYFORM_CCACHE "Take what was compiled before from ccache, where it is installed" ON)
find_program(CCACHE ccache)
if(PLYFORM_CCACHE AND CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${CCACHE})
endif()
