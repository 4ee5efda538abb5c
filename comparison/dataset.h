// SPDX-License-Identifier: GPL-3.0-or-later
// Known symmetries of public data sets, in the layouts in which they come.
#pragma once
#include <string>

#include "ga_symmetry/evaluation.h"
#include "ga_symmetry/symmetry.h"

namespace ga_symmetry::comparison {

struct KnownSymmetry {
  Truth truth;            ///< at least one line
  References references;  ///< empty where the data set has none
  std::string path;       ///< the file that it was read from
};

/// What a folder knows of a mesh, by the name of the mesh's file without its ending. The first of these that is there:
///  NAME.truth                 lines `v w`, 0-based: the partner of vertex v is vertex w;
///                             with NAME.refs beside it: `a0 a1 l r`, two vertices on the axis and a pair
///  NAME.vts, NAME.sym.vts     a vertex a line, 1-based: the partner of a line's vertex is that of the same line in the
///                             other file (Ren, Poulenard, Wonka & Ovsjanikov 2018)
///  NAME.pid, NAME.sym.info    landmarks, the first number of each line a vertex, 0-based; then pairs of line numbers,
///                             0-based, and single ones that are their own partner (Kim, Lipman & Funkhouser 2011).
///                             One pair of files may serve many poses: NAME without the digits at its end, or the only
///                             .pid of the folder
/// @param vertices  of the mesh
/// @throws FileError  in one line, if there is none of them or one cannot be read or names what the mesh does not have
KnownSymmetry read_known_symmetry(const std::string& mesh_path, const std::string& folder, int vertices);

}  // namespace ga_symmetry::comparison
