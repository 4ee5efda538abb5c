// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Evenly Spaced Samples".
#include "ga_symmetry/samples.h"

#include "filters.h"
#include "ga_symmetry/errors.h"
#include "layers.h"
#include "option_parameters.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Vertices evenly spaced by<br>"
    "geodesic distance, as the search<br>"
    "uses them: a layer of points, and<br>"
    "patches of the nearest as colours.";

RichParameterList parameters(const MeshDocument&) {
  RichParameterList list;
  list.addParam(RichInt("samples", 100, "Samples", "At least 1. The first k are the same whatever the number."));
  add_option(list, option_info("largest_component"));
  add_option(list, option_info("threads"));
  return list;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  run.progress(10, "samples");
  const SpacedSamples samples =
      spaced_samples(mesh_of(layer.cm), run.parameters.getInt("samples"), run.parameters.getBool("largest_component"),
                     run.parameters.getInt("threads"), context_of(run).part(0.1, 0.9, "samples"));

  const int count = static_cast<int>(samples.vertex.size());
  const auto color = [&](int i) { return vcg::Color4b::Scatter(count, i); };
  compact(layer.cm);
  CMeshO& points = add_layer(run, layer, "Evenly spaced samples", samples.vertex.size());
  for (int i = 0; i < count; ++i) {
    points.vert[i].P() = layer.cm.vert[samples.vertex[i]].P();
    points.vert[i].N() = layer.cm.vert[samples.vertex[i]].N();
    points.vert[i].Q() = static_cast<Scalarm>(i);
    points.vert[i].C() = vcg::Color4b::Black;  // to be seen on the patches
  }
  vcg::tri::UpdateBounding<CMeshO>::Box(points);
  layer.updateDataMask(MeshModel::MM_VERTCOLOR);
  for (auto& vertex : layer.cm.vert) vertex.C() = vcg::Color4b::Gray;
  int covered = 0;
  for (std::size_t v = 0; v < samples.patch.size(); ++v)
    if (samples.patch[v] >= 0) layer.cm.vert[v].C() = color(samples.patch[v]), ++covered;
  run.log("Samples: " + std::to_string(count) + " of " + std::to_string(covered) + " vertices");
  if (!samples.surface.empty()) run.log("Surface: " + samples.surface);
  return {{"samples", count}};
}

}  // namespace

Filter samples_filter() {
  return {"Intrinsic Symmetry: Evenly Spaced Samples",
          "generate_evenly_spaced_samples",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_VERTCOLOR,
          parameters,
          apply};
}

}  // namespace ga_symmetry
