// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Import Partners".
#include <algorithm>

#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"
#include "layers.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Reads back the partners written<br>"
    "for this mesh. A .json fits its own<br>"
    "mesh only, a .csv any pose of it<br>"
    "with the same vertices.";

RichParameterList parameters(const MeshDocument&) {
  RichParameterList list;
  list.addParam(RichOpenFile("partners_file", "", {"*.csv", "*.json"}, "File",
                             "A .csv with the columns vertex,partner,fitness,side, or a .json."));
  return list;
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  const std::string path = run.parameters.getOpenFileName("partners_file").toLocal8Bit().toStdString();
  if (path.empty())
    throw InvalidOption("choose the file to read the partners from, with the button if a typed name is not taken");
  const TriangleMesh mesh = mesh_of(layer.cm);
  const Partners partners = read_checked_partners(path, mesh);
  store_partners(layer, partners, vertex_colors(mesh, partners, ColorBy::fitness));
  const int matched = static_cast<int>(
      std::count_if(partners.partner.begin(), partners.partner.end(), [](int partner) { return partner >= 0; }));
  run.log("Imported: partners of " + std::to_string(matched) + " of " + std::to_string(partners.partner.size()) +
          " vertices");
  return {{"matched", matched}};
}

}  // namespace

Filter import_partners_filter() {
  return {"Intrinsic Symmetry: Import Partners",
          "load_partners_of_intrinsic_symmetry",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY,
          parameters,
          apply};
}

}  // namespace ga_symmetry
