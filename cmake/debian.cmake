# SPDX-License-Identifier: GPL-3.0-or-later
# cpack: a package of Debian, plyform_VERSION_ARCHITECTURE.deb, with program, Python module, scripts,
# cases and docs, without what other projects build with. What it needs of others is in
# tools/packages.txt, and of libraries what dpkg-shlibdeps finds.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

# packages_of(RESULT GROUP...): those of groups of tools/packages.txt, with commas between.
file(STRINGS ${PROJECT_SOURCE_DIR}/tools/packages.txt package_lines REGEX "^[^#]")
function(packages_of result)
  set(found "")
  set(here FALSE)
  foreach(line IN LISTS package_lines)
    if(line MATCHES "^\\[(.*)\\]$")
      set(here FALSE)
      if("${CMAKE_MATCH_1}" IN_LIST ARGN)
        set(here TRUE)
      endif()
    elseif(here)
      list(APPEND found ${line})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES found)
  list(JOIN found ", " found)
  set(${result} "${found}" PARENT_SCOPE)
endfunction()
packages_of(CPACK_DEBIAN_PACKAGE_DEPENDS report studio)
packages_of(CPACK_DEBIAN_PACKAGE_RECOMMENDS exchange)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME plyform)
set(CPACK_PACKAGE_VENDOR "the developers of plyform")
set(CPACK_PACKAGE_CONTACT "the developers of plyform <plyform@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "forming of stacks of fabric plies, by explicit finite elements")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Simulates how plies of woven and non-crimp fabrics form between punch, die and blank-holder.")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_COMPONENTS_ALL program) # and not development
include(CPack)
