# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install: the program, both libraries with their headers, the cases, and the package that
# find_package(plyform) finds. Headers go to include/plyform/, so that #include "core/model/case.hpp"
# reads the same in other projects as here.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/plyform)

install(TARGETS plyform)
install(TARGETS plyform_contact plyform_core EXPORT plyform)
install(EXPORT plyform FILE plyformTargets.cmake NAMESPACE plyform:: DESTINATION ${package_dir})
install(DIRECTORY contact core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plyform
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/plyformConfig.cmake.in plyformConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS CMAKE_INSTALL_DATADIR)
# Before 1.0 any minor version may change the interface.
write_basic_package_version_file(plyformConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plyformConfig.cmake
              ${PROJECT_BINARY_DIR}/plyformConfigVersion.cmake DESTINATION ${package_dir})
