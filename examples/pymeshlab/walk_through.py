#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Intrinsic symmetry from Python, step by step: find, arrays, mirror, save, picture.

    walk_through.py PLUGIN MESH OUTPUT_FOLDER

Cells begin with `# %%`, so that editors which know notebooks run them one by one. PLUGIN is libfilter_ga_symmetry.so
as built for this PyMeshLab, or - if it is installed there (docs/pymeshlab.md); matplotlib draws the picture.
"""
# %% Load.
import os
import sys

import matplotlib
import numpy
import pymeshlab

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

if len(sys.argv) != 4:
    sys.exit(__doc__)
plugin, path, folder = sys.argv[1:]
if plugin != "-":
    pymeshlab.load_plugin(plugin)
meshes = pymeshlab.MeshSet()
meshes.load_new_mesh(path)

# %% Find every vertex's partner. Nothing is selected and no reference is given: from the shape alone.
found = meshes.apply_filter("compute_intrinsic_symmetry_per_vertex", color_by="Symmetry")
print(f"{found['matched']} vertices have a partner, confidence {found['confidence']:.2f}")

# %% The result as numpy arrays, one entry per vertex.
mesh = meshes.current_mesh()
partner = mesh.vertex_custom_scalar_attribute_array("symmetry_partner").astype(int)  # -1 = none
fitness = mesh.vertex_custom_scalar_attribute_array("symmetry_fitness")  # 0 = distances agree exactly
side = mesh.vertex_custom_scalar_attribute_array("symmetry_side").astype(int)  # +1 left, -1 right, 0 neither
vertices, faces = mesh.vertex_matrix(), mesh.face_matrix()
colors = mesh.vertex_color_matrix()
print(f"left {numpy.sum(side == 1)}, right {numpy.sum(side == -1)}, worst fitness {fitness.max():.2f}")

# %% Any value goes over to the other side by the arrays: here a weight painted on the left.
weight = numpy.where(side == 1, vertices[:, 1], 0.0)
mirrored = numpy.where((side == -1) & (partner >= 0), weight[partner], weight)
print(f"weights: {numpy.count_nonzero(weight)} before, {numpy.count_nonzero(mirrored)} after")

# %% Or by the filters: a colour per place, carried from left to right; then how much the sides differ.
meshes.apply_filter("compute_color_by_function_per_vertex", x="127+127*sin(x/20)", y="127+127*sin(y/20)",
                    z="127+127*sin(z/20)", a="255")
meshes.apply_filter("transfer_attributes_across_intrinsic_symmetry", attribute="Color", direction="Left to right")
asymmetry = meshes.apply_filter("compute_asymmetry_per_vertex", measure="Area")
print(f"asymmetry of area: {asymmetry['mean_size']:.3f} on average")

# %% Save. Attributes go along when they are named.
meshes.save_current_mesh(os.path.join(folder, "walk_through.ply"), **{"__ca_vs__symmetry_partner": True})

# %% A picture: partners in one colour, and lines between some of them.
figure = pyplot.figure(figsize=(8, 8))
axes = figure.add_subplot(projection="3d", proj_type="ortho", computed_zorder=False)
up = vertices[:, [2, 0, 1]]  # y is up in the mesh, z in matplotlib
normals = numpy.cross(up[faces[:, 1]] - up[faces[:, 0]], up[faces[:, 2]] - up[faces[:, 0]])
normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-12)[:, None]
light = 0.55 + 0.45 * numpy.clip(normals @ numpy.array([0.8, 0.3, 0.5]), 0, 1)
surface = axes.plot_trisurf(*up.T, triangles=faces)
surface.set_facecolor(colors[faces, :3].mean(axis=1) * light[:, None])
some = numpy.flatnonzero(side == 1)[:: max(1, numpy.sum(side == 1) // 40)]
for v in some:
    axes.plot(*up[[v, partner[v]]].T, color="0.25", linewidth=0.6)
axes.set_box_aspect(numpy.ptp(up, axis=0))
axes.view_init(elev=8, azim=25)
axes.set_axis_off()
figure.savefig(os.path.join(folder, "walk_through.png"), dpi=110, bbox_inches="tight")
