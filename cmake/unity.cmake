# SPDX-License-Identifier: GPL-3.0-or-later
# plyform_unity(TARGET [ROOM]...): with CMAKE_UNITY_BUILD, as the presets have it, the files of each
# room are compiled as one: what they include and instantiate is most of the work, and is done once.
# Names in the unnamed namespaces of a room's files must differ for that. Files with flags of their
# own stay alone, and those that include CGAL, whose names each of them shortens in its own way; in
# each ROOM they do not, and are compiled as one too, beside the others.
function(plyform_unity target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    get_source_file_property(flags ${source} COMPILE_OPTIONS)
    file(STRINGS ${path} cgal REGEX "#include <CGAL/")
    cmake_path(GET path PARENT_PATH room)
    cmake_path(GET room FILENAME room)
    if(NOT flags AND cgal AND room IN_LIST ARGN)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_cgal)
    elseif(NOT flags AND NOT cgal)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()
