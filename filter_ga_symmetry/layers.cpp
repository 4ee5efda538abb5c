// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <cmath>
#include <cstdio>

#include "ga_symmetry/errors.h"
#include "ga_symmetry/io.h"

namespace ga_symmetry {
namespace {

constexpr const char* kPartner = "symmetry_partner";
constexpr const char* kFitness = "symmetry_fitness";
constexpr const char* kSide = "symmetry_side";
// Every vertex's own index: it differs from where the vertex stands as soon as others have been removed or added.
constexpr const char* kVertex = "symmetry_vertex";

template <class Value>
void set_attribute(CMeshO& m, const char* name, const Value& value) {
  // Handles are told apart by the size of their type only, so an older attribute of this name is no use.
  if (vcg::tri::HasPerVertexAttribute(m, name)) Allocator::DeletePerVertexAttribute(m, name);
  auto attribute = Allocator::AddPerVertexAttribute<Scalarm>(m, name);
  for (std::size_t i = 0; i < m.vert.size(); ++i) attribute[i] = static_cast<Scalarm>(value(i));
}

}  // namespace

MeshModel& current_layer(const FilterRun& run) {
  MeshModel* layer = run.document.mm();
  if (!layer) throw InvalidMesh("there is no mesh; open one first");
  if (sizeof(Scalarm) == sizeof(float) && layer->cm.vn > 1 << 24)
    throw InvalidMesh("a mesh of more than 16777216 vertices has indices that MeshLab's float attributes cannot hold");
  return *layer;
}

TriangleMesh mesh_of(const CMeshO& m) {
  TriangleMesh out;
  out.position.reserve(3 * static_cast<std::size_t>(m.vn));
  out.triangle.reserve(3 * static_cast<std::size_t>(m.fn));
  std::vector<int> number;
  number.reserve(m.vert.size());
  int vertices = 0;
  for (const CVertexO& v : m.vert) {
    number.push_back(vertices);
    if (v.IsD()) continue;
    ++vertices;
    for (int k = 0; k < 3; ++k) out.position.push_back(static_cast<double>(v.cP()[k]));
  }
  for (const CFaceO& f : m.face)
    if (!f.IsD())
      for (int k = 0; k < 3; ++k) out.triangle.push_back(number[vcg::tri::Index(m, f.cV(k))]);
  return out;
}

void compact(CMeshO& m) { Allocator::CompactEveryVector(m); }

Context context_of(const FilterRun& run) {
  Context context;
  context.progress = [&run](double fraction, const char* stage) {
    run.progress(static_cast<int>(100 * fraction), stage);
  };
  return context;
}

ScalarAttribute find_attribute(CMeshO& m, const std::string& name) {
  return Allocator::FindPerVertexAttribute<Scalarm>(m, name);
}

vcg::Color4b meshlab_color(const Color& color) { return {color[0], color[1], color[2], 255}; }

void store_partners(MeshModel& layer, const Partners& p, const std::vector<Color>& colors) {
  CMeshO& m = layer.cm;
  compact(m);
  set_attribute(m, kPartner, [&](std::size_t i) { return p.partner[i]; });
  set_attribute(m, kFitness, [&](std::size_t i) { return p.fitness[i]; });
  set_attribute(m, kSide, [&](std::size_t i) { return p.side[i]; });
  set_attribute(m, kVertex, [](std::size_t i) { return i; });
  layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
  for (std::size_t i = 0; i < m.vert.size(); ++i) {
    m.vert[i].Q() = static_cast<Scalarm>(p.fitness[i]);
    m.vert[i].C() = meshlab_color(colors[i]);
  }
}

bool has_partners(MeshModel& layer) { return Allocator::IsValidHandle(layer.cm, find_attribute(layer.cm, kPartner)); }

Partners stored_partners(MeshModel& layer, const TriangleMesh& mesh) {
  CMeshO& m = layer.cm;
  ScalarAttribute partner = find_attribute(m, kPartner), fitness = find_attribute(m, kFitness),
                  side = find_attribute(m, kSide), vertex = find_attribute(m, kVertex);
  for (const ScalarAttribute& attribute : {partner, fitness, side, vertex})
    if (!Allocator::IsValidHandle(m, attribute))
      throw InvalidOption(
          "this layer has no partners: run \"Intrinsic Symmetry: Find Partners\" or \"Import Partners\" on it first, "
          "or choose the layer that has them");
  Partners out;
  for (std::size_t i = 0; i < m.vert.size(); ++i) {
    if (m.vert[i].IsD()) continue;
    // Also of a vertex that was added: its attributes are 0.
    if (vertex[i] != static_cast<Scalarm>(out.partner.size()) || partner[i] != std::floor(partner[i]))
      throw InvalidOption(
          "vertices have been removed or added since the partners were found: run \"Intrinsic Symmetry: Find "
          "Partners\" again");
    out.partner.push_back(static_cast<int>(partner[i]));
    out.fitness.push_back(fitness[i]);
    out.side.push_back(static_cast<int>(side[i]));
  }
  check_partners(out, mesh);
  return out;
}

CMeshO& add_layer(const FilterRun& run, MeshModel& like, const QString& name, std::size_t points) {
  MeshModel* layer = run.document.addNewMesh("", name, false);
  layer->updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
  layer->cm.Tr = like.cm.Tr;
  Allocator::AddVertices(layer->cm, points);
  return layer->cm;
}

double decimal(Scalarm value) { return QString::number(value, 'g', 7).toDouble(); }

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace ga_symmetry
