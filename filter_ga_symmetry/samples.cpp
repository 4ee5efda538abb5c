// "Intrinsic Symmetry: Evenly Spaced Samples".
#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/sampling.h"
#include "layers.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Vertices evenly spaced by<br>"
    "geodesic distance, as the search<br>"
    "uses them: a layer of points, and<br>"
    "patches of the nearest as colours.";

RichParameterList parameters() {
  RichParameterList list;
  list.addParam(RichInt("samples", 100, "Samples", "At least 1. The first k are the same whatever the number."));
  list.addParam(RichBool("largest_component", false, "Only the largest component",
                         "Instead of refusing a mesh of several components."));
  add_advanced<RichInt>(list, "threads", 0, "Threads", "0 to 256; 0 = all cores. Changes the time, never the result.");
  return list;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  const Surface surface = make_surface(mesh_of(layer.cm), run.parameters.getBool("largest_component"));
  run.progress(10, "samples");
  const Samples samples =
      evenly_spaced_samples(surface, GeodesicSolver(surface), run.parameters.getInt("samples"),
                            run.parameters.getInt("threads"), context_of(run).part(0.1, 0.9, "samples"));
  const std::vector<int> patch = sample_patches(samples);

  const int count = static_cast<int>(samples.vertex.size());
  const auto color = [&](int i) { return vcg::Color4b::Scatter(count, i); };
  compact(layer.cm);
  CMeshO& points = add_layer(run, layer, "Evenly spaced samples", samples.vertex.size());
  for (int i = 0; i < count; ++i) {
    points.vert[i].P() = layer.cm.vert[surface.mesh_vertex[samples.vertex[i]]].P();
    points.vert[i].N() = layer.cm.vert[surface.mesh_vertex[samples.vertex[i]]].N();
    points.vert[i].Q() = static_cast<Scalarm>(i);
    points.vert[i].C() = vcg::Color4b::Black;  // to be seen on the patches
  }
  vcg::tri::UpdateBounding<CMeshO>::Box(points);
  layer.updateDataMask(MeshModel::MM_VERTCOLOR);
  for (auto& vertex : layer.cm.vert) vertex.C() = vcg::Color4b::Gray;
  for (int v = 0; v < surface.vertices(); ++v) layer.cm.vert[surface.mesh_vertex[v]].C() = color(patch[v]);
  run.log("Samples: " + std::to_string(count) + " of " + std::to_string(surface.vertices()) + " vertices");
  for (const std::string& warning : surface.warnings) run.warn("Warning: " + warning);
  return {{"samples", count}};
}

}  // namespace

Filter samples_filter() {
  return {"Intrinsic Symmetry: Evenly Spaced Samples",
          "generate_evenly_spaced_samples",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          parameters,
          apply};
}

}  // namespace ga_symmetry
