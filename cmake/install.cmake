# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install: the program, the libraries with their public headers, the cases, studies, and the
# package that find_package(plyform) finds. Headers go to include/plyform/, so that
# #include "core/model/case.hpp" reads the same in other projects as here.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/plyform)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

install(TARGETS plyform COMPONENT program)
install(TARGETS plyform_base plyform_contact plyform_core plyform_identify EXPORT plyform)
install(EXPORT plyform FILE plyformTargets.cmake NAMESPACE plyform:: DESTINATION ${package_dir})

# From a case to its results, shapes of tools, exact intersections, fits of measured curves; all
# other headers may change at any time. Each includes public ones only, which tests/consumer shows.
set(public_headers
  base/diagnostics.hpp
  base/geometry.hpp
  base/units.hpp
  base/version.hpp
  contact/face_across.hpp
  contact/forces/friction_law.hpp
  contact/intersections.hpp
  contact/search/sheet_bvh.hpp
  contact/shapes/tool_shape.hpp
  contact/simd/contact_points.hpp
  contact/surface_hint.hpp
  core/accuracy/cost_parameters.hpp core/accuracy/error_model.hpp core/accuracy/error_numbers.hpp
  core/identify/column_meaning.hpp
  core/identify/corrections.hpp
  core/identify/curve_file.hpp
  core/identify/curve_table.hpp
  core/identify/disturbances.hpp
  core/identify/fit_quality.hpp
  core/identify/fit_shear.hpp
  core/identify/linear_law.hpp
  core/identify/shear_tests.hpp
  core/identify/statistics.hpp
  core/input/case_file.hpp
  core/input/case_sketch.hpp
  core/input/checks/source_location.hpp
  core/input/keys/case_keys.hpp
  core/mesh/mesh_blank.hpp
  core/model/blank_spec.hpp
  core/model/case.hpp
  core/model/compaction.hpp
  core/model/crimp.hpp
  core/model/energies.hpp
  core/model/fabric.hpp
  core/model/friction.hpp
  core/model/isotropic.hpp
  core/model/law_point.hpp
  core/model/mooney_rivlin.hpp
  core/model/monotone_curve.hpp
  core/model/shear_law.hpp
  core/model/sheet_law.hpp
  core/model/sheet_response.hpp
  core/model/temperature.hpp
  core/model/usual_ranges.hpp
  core/model/viscous_shear.hpp
  core/results/bridging.hpp
  core/results/broken_stitches.hpp
  core/model/description.hpp
  core/results/draw_in.hpp
  core/results/export.hpp
  core/results/frame.hpp
  core/results/mould_fill.hpp
  core/model/ply_frame.hpp
  core/results/result_writer.hpp
  core/results/size_file.hpp
  core/results/summary.hpp
  core/results/verification.hpp
  core/results/wrinkles.hpp
  core/setup/prepare_case.hpp
  core/setup/scene_mesh.hpp
  core/setup/scout.hpp
  core/run/run.hpp)
foreach(header ${public_headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plyform/${folder})
endforeach()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform)
# plyform study, studio, report, map, pattern and export call the programs of their names.
install(PROGRAMS tools/study tools/studio tools/report tools/map tools/pattern tools/export DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform/tools)
install(FILES tools/area_means.py tools/compare.py DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform/tools)
install(PROGRAMS tools/mesh_tool.py tools/check_bands.py tools/check_predictions.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform/tools)
install(DIRECTORY tools/base tools/studies tools/plotting tools/reporting tools/exchange tools/workbench
        DESTINATION ${CMAKE_INSTALL_DATADIR}/plyform/tools
        USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
configure_package_config_file(cmake/plyformConfig.cmake.in plyformConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS CMAKE_INSTALL_DATADIR CMAKE_INSTALL_INCLUDEDIR)
# What a user writes and reads is kept within a major version, the C++ interface is not.
write_basic_package_version_file(plyformConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plyformConfig.cmake
              ${PROJECT_BINARY_DIR}/plyformConfigVersion.cmake DESTINATION ${package_dir})
