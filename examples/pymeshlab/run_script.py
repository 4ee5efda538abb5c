#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a filter script of meshlabserver, unchanged.

    run_script.py PLUGIN MESH SCRIPT.mlx OUT.ply

PLUGIN is libfilter_ga_symmetry.so as built for this PyMeshLab, or - if it is installed there (docs/pymeshlab.md).
"""
import sys

import pymeshlab


def main(plugin, mesh, script, out):
    if plugin != "-":
        pymeshlab.load_plugin(plugin)
    meshes = pymeshlab.MeshSet(verbose=True)
    meshes.load_new_mesh(mesh)
    meshes.load_filter_script(script)
    meshes.apply_filter_script()
    for layer in meshes:
        print("a layer of", layer.vertex_number(), "vertices")
    meshes.set_current_mesh(0)
    meshes.save_current_mesh(out)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
