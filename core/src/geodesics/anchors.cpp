// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesics/anchors.h"

#include <algorithm>
#include <map>

namespace ga_symmetry {

Anchors make_anchors(const SurfaceReferences& references, SymmetryKind kind, const GeodesicSolver& solver, int threads,
                     const Context& context) {
  Anchors out;
  const auto add = [&](int from, int image) {
    out.from.vertex.push_back(from);
    out.image.vertex.push_back(image);
  };
  std::vector<int> axis = references.axis;
  std::vector<std::array<int, 2>> pairs = references.pairs;
  if (kind == SymmetryKind::reflection)
    for (auto& pair : pairs) std::sort(pair.begin(), pair.end());
  std::sort(axis.begin(), axis.end());
  std::sort(pairs.begin(), pairs.end());
  for (const int a : axis) add(a, a);
  for (const auto& [l, r] : pairs) {
    add(l, r);
    if (kind == SymmetryKind::reflection) add(r, l);
  }
  std::map<int, Eigen::Index> row;  // of each different reference
  std::vector<int> sources;
  for (const auto* vertices : {&out.from.vertex, &out.image.vertex})
    for (const int v : *vertices)
      if (row.try_emplace(v, static_cast<Eigen::Index>(sources.size())).second) sources.push_back(v);
  const DistanceFields field = solver.fields(sources, threads, context);
  for (Landmarks* end : {&out.from, &out.image}) {
    end->field.resize(out.count(), field.cols());
    for (int i = 0; i < out.count(); ++i) end->field.row(i) = field.row(row.at(end->vertex[i]));
  }
  return out;
}

}  // namespace ga_symmetry
