# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes report.html of the files that `ga_symmetry compare` wrote.

report.py FOLDER

Exit status: 0 done, 3 jinja2 is missing and there is no page, 4 matplotlib is missing and the page has no plots.
"""
import base64
import json
import os
import sys

sys.dont_write_bytecode = True  # nothing is left where the program is installed

import tables

NO_JINJA, NO_PLOTS = 3, 4

try:
    import jinja2
except ImportError:
    sys.exit(NO_JINJA)
try:
    import plots
except ImportError:
    plots = None


def main():
    folder = sys.argv[1]
    with open(os.path.join(folder, "comparison.json")) as file:
        comparison = json.load(file)
    try:
        with open(os.path.join(folder, "pictures.json")) as file:
            meshes = [picture["mesh"] for picture in json.load(file)]
    except FileNotFoundError:
        sys.exit(f"{folder} has no pictures.json: its page was made before")
    scores = tables.scores(folder)
    images = {name: base64.b64encode(png).decode() for name, png in plots.draw(folder).items()} if plots else {}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(os.path.dirname(os.path.abspath(__file__))),
                                     autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True,
                                     lstrip_blocks=True)
    turns = tables.duration_turns(folder)
    page = environment.get_template("report.html.j2").render(
        comparison=comparison, texts={method["name"]: method["text"] for method in comparison["methods"]},
        summary=tables.summary(scores), accuracy=tables.accuracy(scores),
        mesh_errors=tables.mesh_errors(folder, scores),
        durations=[{"samples": tables.sample_count(turns[large]), "table": tables.durations(turns[large])}
                   for large in (False, True) if turns[large]],
        pair_generations=tables.pair_generations(folder),
        method_generations=tables.method_generations(folder, scores), pictured=meshes, images=images)
    path = os.path.join(folder, "report.html")
    with open(path + ".part", "w") as file:
        file.write(page)
    os.replace(path + ".part", path)
    return 0 if plots else NO_PLOTS


if __name__ == "__main__":
    sys.exit(main())
