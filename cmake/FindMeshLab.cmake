# SPDX-License-Identifier: GPL-3.0-or-later
# Finds what a MeshLab plugin needs: the headers of the source tree that matches the MeshLab in use, its common library,
# and Qt 5. Target: MeshLab::common. Variables: MeshLab_GENERATION (2020, 2022 or 2023), MeshLab_PLUGIN_SUBDIR (where
# this MeshLab looks for plugins below its prefix), MeshLab_PREFIX (of the one in use), MeshLab_VERSION, MeshLab_REASON
# (what is missing and how to get it).
#
# Overrides: -DMESHLAB_SOURCE_DIR=  -DMESHLAB_COMMON_LIBRARY=  -DMESHLAB_DOUBLE=ON
include(MeshLabSource)

set(MESHLAB_DOUBLE OFF CACHE BOOL "The MeshLab in use stores coordinates in double, as PyMeshLab does (not in 2020.09)")

set(MeshLab_REASON "")
unset(MeshLab_INCLUDE_DIR CACHE)
find_path(MeshLab_INCLUDE_DIR NAMES common/interfaces.h common/plugins/interfaces/filter_plugin.h
  HINTS ${GA_SYMMETRY_MESHLAB_SOURCE}/src NO_DEFAULT_PATH)
find_library(MESHLAB_COMMON_LIBRARY NAMES meshlab-common PATH_SUFFIXES meshlab
  DOC "libmeshlab-common.so of the MeshLab in use")
find_program(MESHLAB_EXECUTABLE meshlab)
find_program(MESHLABSERVER_EXECUTABLE meshlabserver)
mark_as_advanced(MESHLAB_EXECUTABLE MESHLABSERVER_EXECUTABLE)
find_package(Qt5 5.9 COMPONENTS Core Widgets OpenGL Xml QUIET)
find_path(MeshLab_GLEW_INCLUDE_DIR GL/glew.h)
mark_as_advanced(MeshLab_INCLUDE_DIR MeshLab_GLEW_INCLUDE_DIR)

if(NOT MeshLab_INCLUDE_DIR)
  list(APPEND MeshLab_REASON "MeshLab's source tree: run scripts/get_meshlab_source, or give -DMESHLAB_SOURCE_DIR=")
endif()
if(NOT MESHLAB_COMMON_LIBRARY)
  list(APPEND MeshLab_REASON "libmeshlab-common.so: apt-get install meshlab, or give -DMESHLAB_COMMON_LIBRARY=")
endif()
if(NOT Qt5_FOUND)
  list(APPEND MeshLab_REASON "Qt 5 with OpenGL: apt-get install qtbase5-dev libqt5opengl5-dev")
endif()
if(NOT MeshLab_GLEW_INCLUDE_DIR)
  list(APPEND MeshLab_REASON "GL/glew.h: apt-get install libglew-dev")
endif()

# The interface a filter has to implement changed twice; each change shows by a header.
if(MeshLab_INCLUDE_DIR)
  if(EXISTS ${MeshLab_INCLUDE_DIR}/common/parameters/rich_parameter/rich_percentage.h)
    set(MeshLab_GENERATION 2023)
  elseif(EXISTS ${MeshLab_INCLUDE_DIR}/common/plugins/interfaces/filter_plugin.h)
    set(MeshLab_GENERATION 2022)
  else()
    set(MeshLab_GENERATION 2020)
  endif()
  if(MESHLAB_DOUBLE AND MeshLab_GENERATION EQUAL 2020)
    list(APPEND MeshLab_REASON "MESHLAB_DOUBLE=OFF: MeshLab 2020.09 is always float")
  endif()

  # 2022.02 and later load only plugins that name their own version.
  file(STRINGS ${GA_SYMMETRY_MESHLAB_SOURCE}/ML_VERSION MeshLab_VERSION LIMIT_COUNT 1)
endif()

if(MeshLab_REASON)
  set(MeshLab_FOUND FALSE)
  list(JOIN MeshLab_REASON "\n  " MeshLab_REASON)
  if(MeshLab_FIND_REQUIRED)
    message(FATAL_ERROR "The MeshLab plugin needs:\n  ${MeshLab_REASON}")
  endif()
else()
  set(MeshLab_FOUND TRUE)
  message(STATUS "Found MeshLab: ${MESHLAB_COMMON_LIBRARY} (headers of ${MeshLab_VERSION})")
endif()

if(MeshLab_FOUND AND NOT TARGET MeshLab::common)
  # Debian's: PREFIX/lib/ARCHITECTURE/meshlab/plugins; later ones: PREFIX/lib/meshlab/plugins; of a PyMeshLab, and of a
  # MeshLab that was not installed: PREFIX/lib/plugins.
  unset(MeshLab_PREFIX)
  if(MeshLab_GENERATION EQUAL 2020)
    set(MeshLab_PLUGIN_SUBDIR lib/meshlab/plugins)
    if(CMAKE_LIBRARY_ARCHITECTURE)
      set(MeshLab_PLUGIN_SUBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE}/meshlab/plugins)
    endif()
    if(MESHLAB_EXECUTABLE)
      cmake_path(GET MESHLAB_EXECUTABLE PARENT_PATH MeshLab_PREFIX)
      cmake_path(GET MeshLab_PREFIX PARENT_PATH MeshLab_PREFIX)
    endif()
  elseif(MESHLAB_COMMON_LIBRARY MATCHES "^(.+)/(lib/meshlab|lib)/[^/]+$")
    set(MeshLab_PREFIX ${CMAKE_MATCH_1})
    set(MeshLab_PLUGIN_SUBDIR ${CMAKE_MATCH_2}/plugins)
  else()
    set(MeshLab_PLUGIN_SUBDIR lib/meshlab/plugins)
  endif()

  add_library(MeshLab::common UNKNOWN IMPORTED)
  set_target_properties(MeshLab::common PROPERTIES IMPORTED_LOCATION ${MESHLAB_COMMON_LIBRARY})
  # MeshLab's own vcglib must come first: the plugin shares its types with the running program.
  target_include_directories(MeshLab::common INTERFACE
    ${MeshLab_INCLUDE_DIR} ${VCGLib_INCLUDE_DIR} ${MeshLab_GLEW_INCLUDE_DIR})
  target_link_libraries(MeshLab::common INTERFACE
    Eigen3::Eigen Qt5::Core Qt5::Widgets Qt5::OpenGL Qt5::Xml)
  # A wrong scalar type compiles, links, loads, and then corrupts memory.
  target_compile_definitions(MeshLab::common INTERFACE
    MESHLAB_GENERATION=${MeshLab_GENERATION}
    MESHLAB_SCALAR=$<IF:$<BOOL:${MESHLAB_DOUBLE}>,double,float>)
  if(NOT MeshLab_GENERATION EQUAL 2020)
    target_compile_definitions(MeshLab::common INTERFACE
      MESHLAB_VERSION=${MeshLab_VERSION}$<$<BOOL:${MESHLAB_DOUBLE}>:d>
      $<$<BOOL:${MESHLAB_DOUBLE}>:MESHLAB_BUILD_WITH_DOUBLE_SCALAR>)
  endif()
endif()
