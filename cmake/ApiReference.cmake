# SPDX-License-Identifier: GPL-3.0-or-later
# The API reference: `cmake --build BUILD --target docs`, then BUILD/docs/html/index.html. All public entities have to be
# documented.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  message(STATUS "The target docs is left out; it needs doxygen")
  return()
endif()
set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_PROJECT_BRIEF "Intrinsic symmetry of triangle meshes")
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${PROJECT_SOURCE_DIR}/docs/api.md)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_STRIP_FROM_INC_PATH ${PROJECT_SOURCE_DIR}/core/include)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR}/core/include)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_GENERATE_LATEX NO)
doxygen_add_docs(docs ${PROJECT_SOURCE_DIR}/docs/api.md ${PROJECT_SOURCE_DIR}/core/include/ga_symmetry
  COMMENT "API reference")
