// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_ga_symmetry.h"

#include "filters.h"
#include "ga_symmetry/errors.h"

using ga_symmetry::Filter;
using ga_symmetry::FilterRun;

namespace {

const Filter& filter(int id) { return ga_symmetry::all_filters()[static_cast<std::size_t>(id)]; }

void report(vcg::CallBackPos* callback, int percent, const char* stage) {
  if (callback && !callback(percent, stage)) throw ga_symmetry::Cancelled();
}

}  // namespace

FilterGaSymmetry::FilterGaSymmetry() {
  for (int id = 0; id < static_cast<int>(ga_symmetry::all_filters().size()); ++id) {
    typeList.push_back(id);
    actionList.push_back(new QAction(filterName(id), this));
  }
}

QString FilterGaSymmetry::filterName(int id) const { return filter(id).name; }
QString FilterGaSymmetry::filterInfo(int id) const { return filter(id).info; }

FilterGaSymmetry::FilterClass FilterGaSymmetry::getClass(ga_symmetry::FilterAction* action)
    GA_SYMMETRY_CONST_SINCE_2022 {
  return static_cast<FilterClass>(filter(ID(action)).filter_class);
}

// Compaction may change the number of vertices. To name it, and nothing else, also keeps the dialog from offering a
// preview, which would run a slow filter at every keystroke, and from putting colours back when it is closed.
int FilterGaSymmetry::postCondition(ga_symmetry::FilterAction*) const { return MeshModel::MM_VERTNUMBER; }

#if MESHLAB_GENERATION == 2020

// The document may be empty, which MeshLab's own version of this function does not survive.
void FilterGaSymmetry::initParameterSet(QAction* action, MeshDocument& document, RichParameterList& parameters) {
  parameters = filter(ID(action)).parameters(document);
}

bool FilterGaSymmetry::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
  const FilterRun run{document, parameters, [&](int percent, const char* stage) { report(callback, percent, stage); },
                      [&](const std::string& line) { Log(line); },
                      [&](const std::string& line) { Log(GLLogStream::WARNING, line); }};
  // Nothing above catches an exception; meshlabserver does not print errorMessage.
  try {
    filter(ID(action)).apply(run);
    return true;
  } catch (const std::exception& error) {
    errorMessage = QString::fromLocal8Bit(error.what());
  } catch (...) {
    errorMessage = "unknown error";
  }
  run.warn(errorMessage.toStdString());
  return false;
}

#else

QString FilterGaSymmetry::pythonFilterName(int id) const { return filter(id).python_name; }

RichParameterList FilterGaSymmetry::initParameterList(const QAction* action, const MeshDocument& document) {
  return filter(ID(action)).parameters(document);
}

std::map<std::string, QVariant> FilterGaSymmetry::applyFilter(const QAction* action,
                                                              const RichParameterList& parameters,
                                                              MeshDocument& document, unsigned int& changed,
                                                              vcg::CallBackPos* callback) {
  const FilterRun run{document, parameters, [&](int percent, const char* stage) { report(callback, percent, stage); },
                      [&](const std::string& line) { log(line); },
                      [&](const std::string& line) { log(GLLogStream::WARNING, line); }};
  try {
    changed = static_cast<unsigned int>(postCondition(action) | filter(ID(action)).changes);
    return filter(ID(action)).apply(run);
  } catch (const std::exception& error) {
    throw MLException(QString::fromLocal8Bit(error.what()));
  }
}

#endif

MESHLAB_PLUGIN_NAME_EXPORTER(FilterGaSymmetry)
