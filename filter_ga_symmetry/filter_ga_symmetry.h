// SPDX-License-Identifier: GPL-3.0-or-later
// The MeshLab plugin: hands MeshLab's calls to the filters.
#pragma once
#include "meshlab_adapter.h"

class FilterGaSymmetry : public QObject, public GA_SYMMETRY_FILTER_INTERFACE {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(GA_SYMMETRY_FILTER_IID)
  Q_INTERFACES(GA_SYMMETRY_FILTER_INTERFACE)

 public:
  FilterGaSymmetry();

  QString pluginName() const override { return "FilterGaSymmetry"; }
  QString filterName(int id) const override;
  QString filterInfo(int id) const override;
  FilterClass getClass(ga_symmetry::FilterAction* action) GA_SYMMETRY_CONST_SINCE_2022 override;
  ga_symmetry::FilterArity filterArity(ga_symmetry::FilterAction*) const override { return SINGLE_MESH; }
  int postCondition(ga_symmetry::FilterAction* action) const override;

#if MESHLAB_GENERATION == 2020
  void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) override;
  bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                   vcg::CallBackPos* callback) override;
#else
  QString vendor() const override { return "ga_symmetry"; }
  QString pythonFilterName(int id) const override;
  RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
  std::map<std::string, QVariant> applyFilter(const QAction* action, const RichParameterList& parameters,
                                              MeshDocument& document, unsigned int& post_condition,
                                              vcg::CallBackPos* callback) override;
#endif
};
