// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a filter script (.mlx) that runs filters of this plugin with their defaults, in the order given. meshlabserver
// wants every parameter listed, with its right type; this knows them from the filters themselves.
//
//   make_filter_script [--select V,V,...] [PYTHON_NAME] [PARAMETER=VALUE]... [PYTHON_NAME [PARAMETER=VALUE]...]...
//   make_filter_script --parameters     the reference of all filters, as Markdown
//
// Parameters before the first name are Find Partners'; without any name that is the filter.
#include <QCoreApplication>
#include <QDomDocument>
#include <QTextStream>
#include <stdexcept>

#include "filters.h"
#include "ga_symmetry/option_table.h"

namespace {

using ga_symmetry::Filter;

QDomElement filter_element(QDomDocument& document, const QString& name) {
  QDomElement element = document.createElement("filter");
  element.setAttribute("name", name);
  document.documentElement().appendChild(element);
  return element;
}

void add_selection(QDomDocument& document, const QString& vertices) {
  QStringList conditions;
  for (const QString& v : vertices.split(',')) conditions << "(vi == " + v + ")";
  RichParameterList list;
  list.addParam(RichString("condSelect", conditions.join(" || ")));
  filter_element(document, "Conditional Vertex Selection").appendChild(list.at(0).fillToXMLDocument(document, false));
}

// Appends the filter; takes its parameters from the front of the arguments.
void add_filter(QDomDocument& document, const Filter& filter, QStringList& arguments) {
  QStringList given;
  while (!arguments.isEmpty() && arguments[0].contains('=')) given << arguments.takeFirst();
  QDomElement element = filter_element(document, filter.name);
  for (const RichParameter& parameter : filter.parameters(MeshDocument())) {
    QDomElement child = parameter.fillToXMLDocument(document, false);
    for (int i = 0; i < given.size(); ++i)
      if (given[i].startsWith(parameter.name() + "="))
        child.setAttribute("value", given.takeAt(i--).mid(parameter.name().size() + 1));
    element.appendChild(child);
  }
  if (!given.isEmpty()) throw std::runtime_error("no parameter for: " + given.join(' ').toStdString());
}

const Filter& filter_named(const QString& name) {
  for (const Filter& filter : ga_symmetry::all_filters())
    if (name == filter.python_name) return filter;
  throw std::runtime_error("no such filter: " + name.toStdString());
}

QString script(QStringList arguments) {
  QDomDocument document("FilterScript");
  document.appendChild(document.createElement("FilterScript"));
  if (arguments.size() >= 2 && arguments[0] == "--select") {
    add_selection(document, arguments[1]);
    arguments = arguments.mid(2);
  }
  if (arguments.isEmpty() || arguments[0].contains('='))
    add_filter(document, ga_symmetry::all_filters().front(), arguments);
  while (!arguments.isEmpty()) add_filter(document, filter_named(arguments.takeFirst()), arguments);
  return document.toString(1);
}

QString plain(QString html) { return html.replace("<br>", " ").remove("<b>").remove("</b>"); }

QString reference() {
  QString out =
      "# Parameters of the filters\n\n"
      "Made by `make_filter_script --parameters` from the filters themselves; a test compares. A choice is given in\n"
      "filter scripts by its number, from 0; in PyMeshLab also by its text.\n";
  for (const Filter& filter : ga_symmetry::all_filters()) {
    out += QString(
               "\n## %1\n\n`%2`\n\n%3\n\n| parameter | type | default | shown as | meaning |\n| --- | --- | --- | "
               "--- | --- |\n")
               .arg(filter.name, filter.python_name, plain(filter.info));
    QDomDocument document;
    for (const RichParameter& parameter : filter.parameters(MeshDocument())) {
      const QDomElement element = parameter.fillToXMLDocument(document, false);
      QString type = element.attribute("type").mid(4), value = element.attribute("value");
      QStringList choices;
      for (int i = 0; element.hasAttribute("enum_val" + QString::number(i)); ++i)
        choices << element.attribute("enum_val" + QString::number(i));
      if (!choices.isEmpty()) type = "choice: " + choices.join(", "), value = choices[value.toInt()];
      out += QString("| `%1` | %2 | %3 | %4 | %5 |\n")
                 .arg(parameter.name(), type, value.isEmpty() ? "" : "`" + value + "`", parameter.fieldDescription(),
                      parameter.toolTip());
    }
  }
  out +=
      "\n## Advanced options of Find Partners\n\n"
      "The text of `advanced`: items `key=value`, separated by commas or blanks, such as `joint_sites=400,\n"
      "fitness=linear`. The command line has them as `--joint-sites 400 --fitness linear`; what is on by default, as\n"
      "`--no-noise-filter`. What does nothing with the chosen method is told in a warning; the command line refuses "
      "it.\n\n"
      "| key | method | default | range | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const ga_symmetry::OptionInfo& info : ga_symmetry::option_table()) {
    if (info.level != ga_symmetry::OptionLevel::expert) continue;
    std::string range = info.range;
    for (const std::string& choice : info.choices) range += (range.empty() ? "" : ", ") + choice;
    const char* method = !info.method ? "both" : *info.method == ga_symmetry::Method::joint ? "joint" : "pairs";
    out += QString("| `%1` | %2 | `%3` | %4 | %5 |\n")
               .arg(QString::fromStdString(info.name), method, QString::fromStdString(info.default_value),
                    QString::fromStdString(range), QString::fromStdString(info.help));
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  qSetGlobalQHashSeed(0);  // the order of XML attributes, the same every time
  QCoreApplication application(argc, argv);
  const QStringList arguments = application.arguments().mid(1);
  try {
    QTextStream(stdout) << (arguments == QStringList("--parameters") ? reference() : script(arguments));
  } catch (const std::exception& error) {
    QTextStream(stderr) << "make_filter_script: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
