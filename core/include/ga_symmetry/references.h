// SPDX-License-Identifier: GPL-3.0-or-later
// What the user knows of the symmetry: vertices on its axis, and pairs that it exchanges.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ga_symmetry/context.h"
#include "ga_symmetry/mesh.h"

namespace ga_symmetry {

struct Options;

/// Reference vertices that the user knows; all indices are vertices of the mesh. Empty = automatic.
struct References {
  std::vector<int> axis;                  ///< on the symmetry axis: the symmetry does not move them
  std::vector<std::array<int, 2>> pairs;  ///< {l, r}: the symmetry takes l to r
  /// Nothing is known.
  bool empty() const { return axis.empty() && pairs.empty(); }
};

/// Reads `a0,a1,l,r` (two axis points, then a pair; further numbers are further pairs), separated by commas, blanks or
/// both, a line end being a blank. One colon makes a pair explicit: `12:57` is a pair, `3,8` two axis points,
/// `3,8,12:57,90:4` two axis points and two pairs. "" = none.
/// @throws InvalidOption  if the text is not of that form
References parse_references(const std::string& text);

/// Reads a file that holds references, as parse_references takes them: NAME.refs beside NAME.off, by convention.
/// @throws FileError  if it cannot be read or is not of that form
References read_references(const std::string& path);

/// Works out which two of four selected vertices lie on the axis and which two are the pair: the pair (c,d) has d(a,c)
/// = d(a,d) and d(b,c) = d(b,d), by geodesic distance; where that is not plain, the one with which the search is more
/// confident, which takes as long as two searches. Order of the input does not matter.
/// @param mesh      any triangle mesh
/// @param selected  four different vertices of its faces
/// @param options   of the search that the references are for: measured is the surface that it would search
/// @param context   progress and cancellation
/// @throws InvalidOption  if two readings are nearly equally good, or a vertex is out of range or repeated
/// @throws InvalidMesh    as find_symmetry
/// @throws Cancelled
References references_from_selection(const TriangleMesh& mesh, const std::array<int, 4>& selected,
                                     const Options& options, const Context& context = {});

}  // namespace ga_symmetry
