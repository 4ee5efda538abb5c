# SPDX-License-Identifier: GPL-3.0-or-later
# MESHLAB_SOURCE_DIR: the source tree of the MeshLab to build for (a release's tree with its vcglib, or Debian's
# unpacked source package). Default: what scripts/get_meshlab_source has fetched.
# Sets GA_SYMMETRY_MESHLAB_SOURCE, empty where there is none.
set(MESHLAB_SOURCE_DIR "" CACHE PATH "MeshLab's source tree; empty = the one that scripts/get_meshlab_source fetched")

if(MESHLAB_SOURCE_DIR)
  set(GA_SYMMETRY_MESHLAB_SOURCE "${MESHLAB_SOURCE_DIR}")
else()
  execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/../scripts/get_meshlab_source --where
    OUTPUT_VARIABLE GA_SYMMETRY_MESHLAB_SOURCE OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
