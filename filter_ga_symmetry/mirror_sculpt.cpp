// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Mirror Sculpt".
#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/mirror.h"
#include "layers.h"
#include "option_parameters.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Carries what was sculpted on one<br>"
    "side to the other, in any pose: the<br>"
    "difference between this layer and<br>"
    "one with the same vertices before.";

RichParameterList parameters(const MeshDocument& document) {
  RichParameterList list;
  add_layer_choice(list, "before", document, "Before sculpting", "The layer as it was; run Find Partners on it.");
  list.addParam(RichEnum("direction", static_cast<int>(Transfer::left_to_right),
                         {"Left to right", "Right to left", "Swap", "Symmetrise"}, "Direction",
                         "Symmetrise: both sides get the mean of what was sculpted."));
  add_option(list, option_info("threads"));
  return list;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  MeshModel* original = chosen_layer(run, "before");
  if (!original || original == &layer)
    throw InvalidOption(
        "the layer before sculpting is missing: duplicate the layer, sculpt the copy, and choose the original here");
  const TriangleMesh before = mesh_of(original->cm), after = mesh_of(layer.cm);
  // A copy has the partners in one generation of MeshLab and not in another.
  const Partners partners = stored_partners(has_partners(*original) ? *original : layer, before);
  const auto transfer = static_cast<Transfer>(run.parameters.getEnum("direction"));
  const std::vector<double> position =
      transferred_shape(before, after, partners, transfer, run.parameters.getInt("threads"), context_of(run));

  CMeshO& m = layer.cm;
  compact(m);
  int changed = 0;  // as single precision sees it, so that the same is said where coordinates are double
  for (std::size_t v = 0; v < m.vert.size(); ++v) {
    const Point3m now(static_cast<Scalarm>(position[3 * v]), static_cast<Scalarm>(position[3 * v + 1]),
                      static_cast<Scalarm>(position[3 * v + 2]));
    changed += vcg::Point3f::Construct(now) != vcg::Point3f::Construct(m.vert[v].cP());
    m.vert[v].P() = now;
  }
  update_box_and_normals(layer);
  run.log("Mirrored the sculpted shape: " + std::to_string(changed) + " vertices moved");
  return {{"changed", changed}};
}

}  // namespace

Filter mirror_sculpt_filter() {
  return {"Intrinsic Symmetry: Mirror Sculpt",
          "transfer_sculpt_across_intrinsic_symmetry",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Smoothing,
          MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL,
          parameters,
          apply};
}

}  // namespace ga_symmetry
