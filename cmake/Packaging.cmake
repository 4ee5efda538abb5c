# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` lays down, the CMake package of the core, and the Debian package.
include(CMakePackageConfigHelpers)
include(ReleaseDate)

# The core, for find_package(ga_symmetry).
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ga_symmetry)
set_target_properties(ga_symmetry_core PROPERTIES EXPORT_NAME core)
install(TARGETS ga_symmetry_core EXPORT ga_symmetryTargets)
install(DIRECTORY core/include/ga_symmetry DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT ga_symmetryTargets NAMESPACE ga_symmetry:: DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ga_symmetryConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/ga_symmetryConfig.cmake ${PROJECT_BINARY_DIR}/ga_symmetryConfigVersion.cmake
  DESTINATION ${package_dir})

# Documents and samples.
set(documents ${CMAKE_INSTALL_DATADIR}/doc/ga-symmetry)
function(install_compressed file name destination)
  set(compressed ${PROJECT_BINARY_DIR}/compressed/${name}.gz)
  add_custom_command(OUTPUT ${compressed} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/compressed
    COMMAND gzip -9nc ${file} > ${compressed}
    DEPENDS ${file} ${ARGN})
  add_custom_target(compress_${name} ALL DEPENDS ${compressed})
  install(FILES ${compressed} DESTINATION ${destination})
endfunction()
if(TARGET ga_symmetry_tool)
  install_compressed(${PROJECT_BINARY_DIR}/tool/ga_symmetry.1 ga_symmetry.1 ${CMAKE_INSTALL_MANDIR}/man1
    ga_symmetry_manual)
endif()
install_compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog ${documents})
install(FILES README.md DESTINATION ${documents})
install(DIRECTORY docs examples DESTINATION ${documents})
install(DIRECTORY sample_meshes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/ga_symmetry/sample_meshes
  FILES_MATCHING PATTERN "*.off" PATTERN "*.mlx" PATTERN "*.refs" PATTERN "*.truth" PATTERN "generator" EXCLUDE)

# ga-symmetry_VERSION_ARCH.deb: cpack -G DEB
set(CPACK_PACKAGE_NAME ga-symmetry)
set(CPACK_PACKAGE_CONTACT "ga_symmetry maintainers <ga_symmetry@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "intrinsic symmetry of triangle meshes, for MeshLab")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "\
Finds for every vertex of a mesh its partner on the other side of the shape,
whatever the pose: as filters of MeshLab, as a command line tool and as a C++
library. Pairs, the symmetry axis, mirrored attributes and a measure of
asymmetry come with it.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-jinja2, python3-matplotlib")  # the page of `ga_symmetry compare`
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(TARGET filter_ga_symmetry)
  # A plugin fits the release that it was compiled for only.
  string(REGEX MATCH "^[0-9]+\\.[0-9]+" meshlab_release ${MeshLab_VERSION})
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "meshlab (>= ${meshlab_release}), meshlab (<< ${meshlab_release}.999)")
  cmake_path(GET MESHLAB_COMMON_LIBRARY PARENT_PATH CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS)
endif()
set(debian ${PROJECT_BINARY_DIR}/debian)
file(WRITE ${debian}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ga_symmetry

Files: *
Copyright: 2026 the authors of ga_symmetry
 2004-2020 Visual Computing Lab, ISTI - CNR (vcglib, parts of which are compiled in)
License: GPL-3
 On Debian systems the full text of the licence is in /usr/share/common-licenses/GPL-3.
")
release_date(date ${PROJECT_VERSION} ${PROJECT_SOURCE_DIR}/CHANGELOG.md "%a, %d %b %Y %H:%M:%S +0000")
file(WRITE ${debian}/changelog "ga-symmetry (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; changelog.gz says what is new.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
install(FILES ${debian}/copyright DESTINATION ${documents})
install_compressed(${debian}/changelog changelog.Debian ${documents})
include(CPack)
