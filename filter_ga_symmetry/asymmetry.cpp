// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Asymmetry".
#include "ga_symmetry/asymmetry.h"

#include <algorithm>
#include <cmath>

#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "layers.h"
#include "option_parameters.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "How much the two sides differ<br>"
    "around each vertex, in any pose;<br>"
    "after Find Partners. Red: this side<br>"
    "has more, blue: it has less. Area<br>"
    "and Length: 0.1 is 10 % more.";

RichParameterList parameters(const MeshDocument&) {
  const AsymmetryOptions defaults;
  RichParameterList list;
  list.addParam(RichEnum("measure", static_cast<int>(defaults.measure), {"Area", "Length", "Mean curvature"}, "Measure",
                         "What is compared. Mean curvature: difference times sqrt(area), convex is more."));
  list.addParam(RichFloat("radius", static_cast<float>(defaults.radius), "Radius",
                          "Of the discs compared, over sqrt(area), up to 1. The time grows with its square."));
  add_option(list, option_info("threads"));
  return list;
}

// White at 0, red at `top`, blue at -top.
vcg::Color4b signed_color(double value, double top) {
  const double share = top > 0 ? std::min(1.0, std::abs(value) / top) : 0;
  const auto faded = static_cast<unsigned char>(std::lround(255 * (1 - share)));
  return value > 0 ? vcg::Color4b(255, faded, faded, 255) : vcg::Color4b(faded, faded, 255, 255);
}

// The size whose colour is full: the 95th percentile over the vertices with a partner, so that a few do not leave all
// others white. 0 if there are none.
double full_color(const std::vector<double>& values, const std::vector<int>& partner) {
  std::vector<double> sizes;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (partner[v] >= 0) sizes.push_back(std::abs(values[v]));
  if (sizes.empty()) return 0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  CMeshO& m = layer.cm;
  const TriangleMesh mesh = mesh_of(m);
  const Partners partners = stored_partners(layer, mesh);
  AsymmetryOptions options;
  options.measure = static_cast<AsymmetryMeasure>(run.parameters.getEnum("measure"));
  options.radius = decimal(run.parameters.getFloat("radius"));
  options.threads = run.parameters.getInt("threads");
  const std::vector<double> values = asymmetry(mesh, partners, options, context_of(run));

  double sum = 0;
  for (const double value : values) sum += std::abs(value);
  const double top = full_color(values, partners.partner);
  compact(m);
  layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
  for (std::size_t v = 0; v < values.size(); ++v) {
    m.vert[v].Q() = static_cast<Scalarm>(values[v]);
    m.vert[v].C() = signed_color(values[v], top);
  }
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double mean = sum / static_cast<double>(values.size());
  run.log("Asymmetry: " + text("%.4g", *lowest) + " to " + text("%.4g", *highest) + ", mean size " +
          text("%.4g", mean) + ", full colour at " + text("%.4g", top));
  return {{"lowest", *lowest}, {"highest", *highest}, {"mean_size", mean}};
}

}  // namespace

Filter asymmetry_filter() {
  return {"Intrinsic Symmetry: Asymmetry",
          "compute_asymmetry_per_vertex",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY,
          parameters,
          apply};
}

}  // namespace ga_symmetry
