// SPDX-License-Identifier: GPL-3.0-or-later
// What differs between MeshLab's generations of the filter interface: 2020.09, 2022.02, and 2023.12 with 2025.07.
// CMake finds out from the headers which one it is (MESHLAB_GENERATION); the filters themselves do not know.
#pragma once

#if MESHLAB_GENERATION == 2020
#include <common/interfaces.h>
#define GA_SYMMETRY_FILTER_INTERFACE MeshFilterInterface
#define GA_SYMMETRY_FILTER_IID MESH_FILTER_INTERFACE_IID
#define GA_SYMMETRY_CONST_SINCE_2022
#else
#include <common/mlexception.h>
#include <common/plugins/interfaces/filter_plugin.h>
#define GA_SYMMETRY_FILTER_INTERFACE FilterPlugin
#define GA_SYMMETRY_FILTER_IID FILTER_PLUGIN_IID
#define GA_SYMMETRY_CONST_SINCE_2022 const
#endif

#include <functional>
#include <map>
#include <string>

namespace ga_symmetry {

#if MESHLAB_GENERATION == 2020
using FilterAction = QAction;
using FilterArity = MeshFilterInterface::FILTER_ARITY;
#else
using FilterAction = const QAction;
using FilterArity = FilterPlugin::FilterArity;
#endif

#if MESHLAB_GENERATION >= 2023
using RichSaveFile = RichFileSave;
using RichOpenFile = RichFileOpen;
#endif

/// Adds a parameter that MeshLab, where it can, folds away until asked for.
template <class Parameter, class... Arguments>
void add_advanced(RichParameterList& list, const Arguments&... arguments) {
#if MESHLAB_GENERATION == 2020
  list.addParam(Parameter(arguments...));
#else
  list.addParam(Parameter(arguments..., true));
#endif
}

/// One application of a filter: what it works on and whom it tells.
struct FilterRun {
  MeshDocument& document;
  const RichParameterList& parameters;
  std::function<void(int percent, const char* stage)> progress;  ///< throws Cancelled if asked to stop
  std::function<void(const std::string& line)> log;
  std::function<void(const std::string& line)> warn;
};

/// Adds a choice among the document's layers: one that is not the current one, if there is one.
inline void add_layer_choice(RichParameterList& list, const QString& name, const MeshDocument& document,
                             const QString& description, const QString& tooltip) {
#if MESHLAB_GENERATION == 2020
  auto& layers = const_cast<MeshDocument&>(document);  // what RichMesh asks for; it only reads
  MeshModel* other = nullptr;
  for (MeshModel* layer : layers.meshList)
    if (!other || other == layers.mm()) other = layer;
  if (other)
    list.addParam(RichMesh(name, other, &layers, description, tooltip));
  else
    list.addParam(RichMesh(name, 0, description, tooltip));
#else
  const MeshModel* other = nullptr;
  for (const MeshModel& layer : document.meshIterator())
    if (!other || other == document.mm()) other = &layer;
  list.addParam(RichMesh(name, other ? static_cast<unsigned int>(other->id()) : 0u, &document, description, tooltip));
#endif
}

/// The layer that was chosen. nullptr: there is none such
inline MeshModel* chosen_layer(const FilterRun& run, const QString& name) {
#if MESHLAB_GENERATION == 2020
  return run.parameters.getMesh(name);
#else
  return run.document.getMesh(run.parameters.getMeshId(name));
#endif
}

/// After vertices have moved.
inline void update_box_and_normals(MeshModel& layer) {
#if MESHLAB_GENERATION == 2020
  layer.UpdateBoxAndNormals();
#else
  layer.updateBoxAndNormals();
#endif
}

/// Named values for scripts; seen by PyMeshLab only.
using FilterOutputs = std::map<std::string, QVariant>;

/// A filter, as every generation of MeshLab can run it. `apply` throws std::exception with a line for the user, and
/// has then changed nothing.
struct Filter {
  const char* name;                                               ///< in menus and .mlx scripts
  const char* python_name;                                        ///< in PyMeshLab
  const char* info;                                               ///< HTML, on top of the dialog
  int filter_class;                                               ///< FilterClass bits: the menus it appears in
  int changes;                                                    ///< MeshModel bits: what a window draws anew
  RichParameterList (*parameters)(const MeshDocument& document);  ///< which may be empty
  FilterOutputs (*apply)(const FilterRun& run);
};

}  // namespace ga_symmetry
