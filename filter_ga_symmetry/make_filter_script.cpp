// Prints a filter script (.mlx) that runs Find Partners with its defaults. meshlabserver wants every parameter listed,
// with its right type; this knows them from the filter itself.
//
//   make_filter_script [--select V,V,...] [PARAMETER=VALUE]...
#include <QCoreApplication>
#include <QDomDocument>
#include <QTextStream>

#include "find_partners.h"

namespace {

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

}  // namespace

int main(int argc, char** argv) {
  qSetGlobalQHashSeed(0);  // the order of XML attributes, the same every time
  QCoreApplication application(argc, argv);
  QStringList arguments = application.arguments().mid(1);

  QDomDocument document("FilterScript");
  document.appendChild(document.createElement("FilterScript"));
  if (arguments.size() >= 2 && arguments[0] == "--select") {
    add_selection(document, arguments[1]);
    arguments = arguments.mid(2);
  }
  const ga_symmetry::Filter filter = ga_symmetry::find_partners_filter();
  QDomElement element = filter_element(document, filter.name);
  for (const RichParameter& parameter : filter.parameters()) {
    QDomElement child = parameter.fillToXMLDocument(document, false);
    for (int i = 0; i < arguments.size(); ++i)
      if (arguments[i].startsWith(parameter.name() + "="))
        child.setAttribute("value", arguments.takeAt(i--).mid(parameter.name().size() + 1));
    element.appendChild(child);
  }
  if (!arguments.isEmpty()) {
    QTextStream(stderr) << "make_filter_script: no parameter for: " << arguments.join(' ') << "\n";
    return 2;
  }
  QTextStream(stdout) << document.toString(1);
}
