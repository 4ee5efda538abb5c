// SPDX-License-Identifier: GPL-3.0-or-later
// "Intrinsic Symmetry: Mirror Attributes".
#include <cmath>

#include "filters.h"
#include "ga_symmetry/errors.h"
#include "ga_symmetry/mirror.h"
#include "layers.h"

namespace ga_symmetry {
namespace {

constexpr const char* info =
    "Carries a selection, colours, quality<br>"
    "or weights to the other side, in any<br>"
    "pose; after Find Partners. Left is<br>"
    "where symmetry_side is +1.";

enum Attribute { kSelection, kColor, kQuality, kCustom };

RichParameterList parameters(const MeshDocument&) {
  RichParameterList list;
  list.addParam(
      RichEnum("attribute", kColor, {"Selection", "Color", "Quality", "Custom attribute"}, "What", "Of the vertices."));
  list.addParam(RichString("custom_attribute", "", "Custom attribute", "The name of a scalar attribute of vertices."));
  list.addParam(RichEnum("direction", static_cast<int>(Transfer::left_to_right),
                         {"Left to right", "Right to left", "Swap", "Average"}, "Direction",
                         "Average: both sides get the mean; of selections, both get what either has."));
  return list;
}

template <class Get, class Set>
void transfer_numbers(CMeshO& m, const TransferPlan& plan, Transfer transfer, const Get& get, const Set& set) {
  compact(m);
  std::vector<double> values;
  for (std::size_t v = 0; v < m.vert.size(); ++v) values.push_back(get(v));
  values = transferred(values, plan, transfer);
  for (std::size_t v = 0; v < m.vert.size(); ++v)
    if (plan.source[v] >= 0) set(v, values[v]);
}

FilterOutputs apply(const FilterRun& run) {
  MeshModel& layer = current_layer(run);
  CMeshO& m = layer.cm;
  const Partners partners = stored_partners(layer, mesh_of(m));
  const auto transfer = static_cast<Transfer>(run.parameters.getEnum("direction"));
  const TransferPlan plan = plan_transfer(partners, transfer);
  switch (run.parameters.getEnum("attribute")) {
    case kSelection:
      transfer_numbers(
          m, plan, transfer, [&](std::size_t v) { return m.vert[v].IsS() ? 1.0 : 0.0; },
          [&](std::size_t v, double selected) { selected > 0 ? m.vert[v].SetS() : m.vert[v].ClearS(); });
      break;
    case kColor:
      if (!layer.hasDataMask(MeshModel::MM_VERTCOLOR))
        throw InvalidOption("the vertices have no colors to carry: color them first");
      for (int channel = 0; channel < 4; ++channel)
        transfer_numbers(
            m, plan, transfer, [&](std::size_t v) { return m.vert[v].C()[channel]; },
            [&](std::size_t v, double value) {
              m.vert[v].C()[channel] = static_cast<unsigned char>(std::lround(value));
            });
      break;
    case kQuality:
      if (!layer.hasDataMask(MeshModel::MM_VERTQUALITY))
        throw InvalidOption("the vertices have no quality to carry: compute one first");
      transfer_numbers(
          m, plan, transfer, [&](std::size_t v) { return m.vert[v].Q(); },
          [&](std::size_t v, double value) { m.vert[v].Q() = static_cast<Scalarm>(value); });
      break;
    case kCustom: {
      const std::string name = run.parameters.getString("custom_attribute").toStdString();
      ScalarAttribute attribute = find_attribute(m, name);
      if (name.empty() || !Allocator::IsValidHandle(m, attribute))
        throw InvalidOption("the vertices have no scalar attribute named \"" + name +
                            "\": give the name of one, as \"Define New Per Vertex Attribute\" makes it");
      transfer_numbers(
          m, plan, transfer, [&](std::size_t v) { return attribute[v]; },
          [&](std::size_t v, double value) { attribute[v] = static_cast<Scalarm>(value); });
      break;
    }
    default:
      throw InvalidOption("attribute must be Selection, Color, Quality or Custom attribute");
  }
  run.log("Mirrored: " + std::to_string(plan.changed) + " vertices changed, " + std::to_string(plan.without_partner) +
          " left as they were for want of a partner");
  return {{"changed", plan.changed}, {"without_partner", plan.without_partner}};
}

}  // namespace

Filter mirror_attributes_filter() {
  return {"Intrinsic Symmetry: Mirror Attributes",
          "transfer_attributes_across_intrinsic_symmetry",
          info,
          GA_SYMMETRY_FILTER_INTERFACE::Quality,
          MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTFLAGSELECT,
          parameters,
          apply};
}

}  // namespace ga_symmetry
