// SPDX-License-Identifier: GPL-3.0-or-later
// What the filters share: the current layer, the partners that it keeps as attributes, colours, new layers.
#pragma once
#include "ga_symmetry/colors.h"
#include "ga_symmetry/context.h"
#include "ga_symmetry/partners.h"
#include "meshlab_adapter.h"

namespace ga_symmetry {

using Allocator = vcg::tri::Allocator<CMeshO>;
using ScalarAttribute = CMeshO::PerVertexAttributeHandle<Scalarm>;

/// The current layer, as it is. @throws InvalidMesh  if there is none
MeshModel& current_layer(const FilterRun& run);

/// The layer's mesh without deleted elements: numbered as it is after compact().
TriangleMesh mesh_of(const CMeshO& m);

/// Removes deleted elements for good. Not before all that may fail is done: a filter that fails changes nothing.
void compact(CMeshO& m);

/// Passes progress on to MeshLab, and its wish to stop.
Context context_of(const FilterRun& run);

/// The attribute of that name, or an invalid handle.
ScalarAttribute find_attribute(CMeshO& m, const std::string& name);

vcg::Color4b meshlab_color(const Color& color);

/// Compacts the mesh and keeps the partners as attributes, the fitness as quality, and the colours. Fails only for want
/// of memory.
void store_partners(MeshModel& layer, const Partners& partners, const std::vector<Color>& colors);

/// Does the layer keep partners, whether or not they fit it?
bool has_partners(MeshModel& layer);

/// The partners that the layer keeps. @throws InvalidOption  if there are none, or the mesh has changed since
Partners stored_partners(MeshModel& layer, const TriangleMesh& mesh);

/// A new layer in the same place as `like`, with so many points. The current layer stays current.
CMeshO& add_layer(const FilterRun& run, MeshModel& like, const QString& name, std::size_t points);

/// MeshLab's float of a decimal number, as the double of that number: the dialog's 1.96 is the command line's 1.96.
double decimal(Scalarm value);

std::string text(const char* format, double value);

}  // namespace ga_symmetry
