#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find the partners of a mesh's vertices, read them as an array, mirror a colour, and save the mesh.

    mirror_color.py PLUGIN MESH a0,a1,l,r OUT.ply

PLUGIN is libfilter_ga_symmetry.so as built for this PyMeshLab, or - if it is installed there (docs/pymeshlab.md).
"""
import sys

import pymeshlab


def main(plugin, mesh, references, out):
    if plugin != "-":
        pymeshlab.load_plugin(plugin)
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(mesh)

    found = meshes.apply_filter("compute_intrinsic_symmetry_per_vertex", references=references)
    partner = meshes.current_mesh().vertex_custom_scalar_attribute_array("symmetry_partner").astype(int)
    side = meshes.current_mesh().vertex_custom_scalar_attribute_array("symmetry_side").astype(int)
    print(f"{found['matched']} of {len(partner)} vertices have a partner, mean fitness {found['mean_fitness']:.3g}")

    # A colour that tells every place on the body from every other, carried from the left to the right.
    meshes.apply_filter("compute_color_by_function_per_vertex", x="127+127*sin(x/20)", y="127+127*sin(y/20)",
                        z="127+127*sin(z/20)", a="255")
    mirrored = meshes.apply_filter("transfer_attributes_across_intrinsic_symmetry", attribute="Color",
                                   direction="Left to right")
    color = meshes.current_mesh().vertex_color_matrix()
    right = [v for v in range(len(partner)) if side[v] == -1 and partner[v] >= 0 and side[partner[v]] != -1]
    assert mirrored["changed"] == len(right)
    assert all((color[v] == color[partner[v]]).all() for v in right)
    print(f"{mirrored['changed']} vertices took their partner's colour, {mirrored['without_partner']} had none")

    meshes.save_current_mesh(out, binary=False, **{"__ca_vs__symmetry_partner": True})


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
