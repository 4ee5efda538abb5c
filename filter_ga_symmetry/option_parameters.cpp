// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_parameters.h"

#include <QString>

#include "layers.h"

namespace ga_symmetry {
namespace {

QString capitalized(const std::string& word) {
  const QString text = QString::fromStdString(word);
  return text.left(1).toUpper() + text.mid(1);
}

// For whom, what, and in which range.
QString tooltip(const OptionInfo& info, const char* more) {
  QString help = QString::fromStdString(info.help);
  if (info.method)
    help = (*info.method == Method::joint ? "Joint: " : "Pairs: ") + help.left(1).toLower() + help.mid(1);
  if (!info.range.empty()) help += "; " + QString::fromStdString(info.range);
  return help + "." + more;
}

template <class Parameter, class Value>
void add(RichParameterList& list, const OptionInfo& info, const char* more, const Value& value) {
  const QString name = QString::fromStdString(info.name), label = QString::fromStdString(info.label);
  if (info.level == OptionLevel::basic)
    list.addParam(Parameter(name, value, label, tooltip(info, more)));
  else
    add_advanced<Parameter>(list, name, value, label, tooltip(info, more));
}

}  // namespace

void add_option(RichParameterList& list, const OptionInfo& info, const char* more) {
  const QString value = QString::fromStdString(info.default_value), name = QString::fromStdString(info.name);
  switch (info.kind) {
    case OptionKind::flag:
      return add<RichBool>(list, info, more, value == "true");
    case OptionKind::integer:
      return add<RichInt>(list, info, more, value.toInt());
    case OptionKind::real:
      return add<RichFloat>(list, info, more, static_cast<Scalarm>(value.toDouble()));
    case OptionKind::references:
      return add<RichString>(list, info, more, value);
    case OptionKind::choice:
      break;
  }
  QStringList choices;
  int chosen = 0;
  for (const std::string& choice : info.choices) {
    if (choice == info.default_value) chosen = choices.size();
    choices << capitalized(choice);
  }
  list.addParam(RichEnum(name, chosen, choices, QString::fromStdString(info.label), tooltip(info, more)));
}

void read_option(const RichParameterList& list, const OptionInfo& info, Options& options) {
  const QString name = QString::fromStdString(info.name);
  QString value;
  switch (info.kind) {
    case OptionKind::flag:
      value = list.getBool(name) ? "true" : "false";
      break;
    case OptionKind::integer:
      value = QString::number(list.getInt(name));
      break;
    case OptionKind::real:
      value = QString::number(decimal(list.getFloat(name)), 'g', 17);
      break;
    case OptionKind::references:
      value = list.getString(name);
      break;
    case OptionKind::choice: {
      const int index = list.getEnum(name);
      value = index >= 0 && index < static_cast<int>(info.choices.size())
                  ? QString::fromStdString(info.choices[static_cast<std::size_t>(index)])
                  : QString::number(index);
    }
  }
  set_option(options, info.name, value.toStdString());
}

}  // namespace ga_symmetry
