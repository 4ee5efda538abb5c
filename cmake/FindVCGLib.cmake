# SPDX-License-Identifier: GPL-3.0-or-later
# Finds vcglib: in -DVCGLIB_DIR=, in MeshLab's source tree, or installed.
# Target: VCGLib::VCGLib (headers). Whatever reads or writes PLY files compiles ${VCGLib_INCLUDE_DIR}/wrap/ply/plylib.cpp.
include(MeshLabSource)
set(VCGLIB_DIR "" CACHE PATH "vcglib: the directory that holds vcg/ and wrap/")

set(_vcglib_hints)
if(VCGLIB_DIR)
  set(_vcglib_hints "${VCGLIB_DIR}")
elseif(GA_SYMMETRY_MESHLAB_SOURCE)
  set(_vcglib_hints "${GA_SYMMETRY_MESHLAB_SOURCE}/vcglib" "${GA_SYMMETRY_MESHLAB_SOURCE}/src/vcglib")
endif()
unset(VCGLib_INCLUDE_DIR CACHE)
find_path(VCGLib_INCLUDE_DIR wrap/ply/plylib.cpp HINTS ${_vcglib_hints} PATH_SUFFIXES vcglib)
mark_as_advanced(VCGLib_INCLUDE_DIR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(VCGLib REQUIRED_VARS VCGLib_INCLUDE_DIR REASON_FAILURE_MESSAGE
  "vcglib comes with MeshLab's source: run scripts/get_meshlab_source, or give -DMESHLAB_SOURCE_DIR= or -DVCGLIB_DIR=")

if(VCGLib_FOUND AND NOT TARGET VCGLib::VCGLib)
  add_library(VCGLib::VCGLib INTERFACE IMPORTED)
  target_include_directories(VCGLib::VCGLib INTERFACE ${VCGLib_INCLUDE_DIR})
  target_link_libraries(VCGLib::VCGLib INTERFACE Eigen3::Eigen)
endif()
