#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the seeds of the fuzz targets: small inputs of every format, most of them valid. make_seeds.py FOLDER"""
import json
import pathlib
import struct
import sys

folder = pathlib.Path(sys.argv[1])


def seed(target, name, content):
    path = folder / target / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


V = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.5)]
F = [(0, 1, 2), (0, 2, 3)]
rows = "".join("%g %g %g\n" % v for v in V)
seed("mesh_file", "off", "\x00OFF\n# two faces\n4 2 0\n" + rows + "3 0 1 2\n3 0 2 3\n")
seed("mesh_file", "off_quad", "\x00OFF 4 1 0\n" + rows + "4 0 1 2 3\n")
seed("mesh_file", "off_colour", "\x00COFF\n4 1 0\n" + "".join("%g %g %g 255 0 0 255\n" % v for v in V) + "4 0 1 2 3 1 0 0\n")
seed("mesh_file", "off_normal_texture", "\x00STNOFF\n4 1 0\n" + "".join("%g %g %g 0 0 1 0.5 0.5\n" % v for v in V) + "4 0 1 2 3\n")
header = "ply\nformat %s 1.0\ncomment seed\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n%selement face 2\nproperty list uchar int vertex_indices\nend_header\n"
seed("mesh_file", "ply_ascii", "\x01" + header % ("ascii", "") + rows + "3 0 1 2\n3 0 2 3\n")
seed("mesh_file", "ply_ascii_quality", "\x01" + header % ("ascii", "property uchar red\n") + "".join("%g %g %g 200\n" % v for v in V) + "3 0 1 2\n3 0 2 3\n")
edges = header.replace("end_header", "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header")
seed("mesh_file", "ply_edges", "\x01" + edges % ("ascii", "") + rows + "3 0 1 2\n3 0 2 3\n0 2\n")
seed("mesh_file", "ply_edges_binary", b"\x01" + (edges % ("binary_little_endian", "")).encode() + b"".join(
    struct.pack("<3f", *v) for v in V) + b"".join(struct.pack("<B3i", 3, *f) for f in F) + struct.pack("<2i", 0, 2))
for order, name in (("<", "binary_little_endian"), (">", "binary_big_endian")):
    body = b"".join(struct.pack(order + "3f", *v) for v in V) + b"".join(struct.pack(order + "B3i", 3, *f) for f in F)
    seed("mesh_file", "ply_" + name, b"\x01" + (header % (name, "")).encode() + body)
doubles = (header % ("binary_little_endian", "property list uchar float extra\n")).replace("float x", "double x")
seed("mesh_file", "ply_list", b"\x01" + doubles.encode() + b"".join(
    struct.pack("<d2fBf", *v, 1, 0.5) for v in V) + b"".join(struct.pack("<B3i", 3, *f) for f in F))
lists = header.replace("element face", "property list double int extra\nelement face")
seed("mesh_file", "ply_list_double", "\x01" + lists % ("ascii", "") + "".join("%g %g %g 0\n" % v for v in V) + "3 0 1 2\n3 0 2 3\n")
strips = header.replace("element face 2\nproperty list uchar", "element tristrips 1\nproperty list int")
seed("mesh_file", "ply_tristrips", "\x01" + strips % ("ascii", "") + rows + "8 0 1 2 3 -1 3 1 0\n")
seed("mesh_file", "ply_tristrips_binary", b"\x01" + (strips % ("binary_big_endian", "")).encode() + b"".join(
    struct.pack(">3f", *v) for v in V) + struct.pack(">9i", 8, 0, 1, 2, 3, -1, 3, 1, 0))
# The kind, the format, which elements; then each element: rows, types of what counts, how many others behind each.
made = bytes([4, 0, 2, 4, 6, 0, 6, 0, 7, 0, 0, 1, 1, 4, 0])
seed("mesh_file", "ply_made", made + ("".join("%g %g %g\n" % v for v in V) + "3 0 1 2\n").encode())
seed("mesh_file", "ply_made_others", bytes([4, 0, 14, 4, 6, 1, 1, 7, 4, 6, 0, 7, 1, 0, 5, 0, 1, 3, 2, 0, 2, 4, 4, 0])
     + ("".join("%g 0 %g %g 3\n" % v for v in V) + "3 0 1 2\n4 0 1 2 3\n3 1 2 3\n").encode())
seed("mesh_file", "ply_made_binary", bytes([4, 1, 2, 4, 6, 0, 6, 0, 6, 0, 0, 1, 1, 4, 0])
     + b"".join(struct.pack("<3f", *v) for v in V) + struct.pack("<B3i", 3, 0, 1, 2))
seed("mesh_file", "off_glued", "\x00OFF4 3 0\n# rows\n" + rows + "3 0 1 2 255 0 0\n2 0 1\n0\n")
seed("mesh_file", "obj", "\x02o seed\n" + "".join("v %g %g %g\n" % v for v in V) + "vn 0 0 1\nf 1/1/1 2 3//1\nf -4 -2 \\\n-1\n")
facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex %g %g %g\n" % V[i] for i in f) + "endloop\nendfacet\n" for f in F)
seed("mesh_file", "stl_ascii", "\x03solid s\n" + facets + "endsolid s\n")
seed("mesh_file", "stl_binary", b"\x03" + bytes(80) + struct.pack("<I", 2) + b"".join(
    struct.pack("<12fH", 0, 0, 1, *(x for i in f for x in V[i]), 0) for f in F))

table = "vertex,partner,fitness,side\n" + "".join(f"{i},{i // 5 * 5 + 4 - i % 5},0.01,{(i % 5 < 2) - (i % 5 > 2)}\n" for i in range(25))
seed("partners", "csv", "\x00" + table)
seed("partners", "csv_short", "\x00vertex partner\r\n0 -1\r\n")


def checksum():
    """Of the mesh in partners.cpp, as in io.h; without it nothing behind the checksum is reached."""
    data = struct.pack("<QQ", 25, 32)
    for i in range(25):
        data += struct.pack("<3f", i % 5, i // 5, 0.1 * (i % 3))
    for i in range(25):
        if i % 5 < 4 and i // 5 < 4:
            data += struct.pack("<6i", i, i + 1, i + 6, i, i + 6, i + 5)
    value = 14695981039346656037
    for byte in data:
        value = (value ^ byte) * 1099511628211 & (1 << 64) - 1
    return f"fnv1a64:{value:016x}"


result = {"format": "ga_symmetry result", "version": 1, "mesh": {"vertices": 25, "triangles": 32, "checksum": checksum()},
          "partner": list(range(25)), "fitness": [0.0] * 25, "side": [0] * 25}
seed("partners", "json", "\x01" + json.dumps(result))
result["partner"][3], result["side"][4] = 1e99, 2**32
seed("partners", "json_out_of_range", "\x01" + json.dumps(result))
seed("partners", "values", "\x02arm,vertex,leg\n" + "".join(f"0.5,{i},1e-3\n" for i in range(25)))
seed("partners", "truth", "\x03" + "".join(f"{i} {24 - i}\n" for i in range(25)))

for i, text in enumerate(("", "12,40,7,9", "12,40,7:9,3:5", " 3 , 8 ", "1,2,3,4,5,6", "2147483648", "1:1", "1,1", "-1,2")):
    seed("references", str(i), text)

for i, text in enumerate(("", "joint_sites=400, fitness=linear", "noise_filter=true\tpairs_barrier=-1.96", "?", "joint_sites=",
                          "joint_ruin=1e999", "joint_sites=1 joint_sites=2", "joint_mutation=nan")):
    seed("option_text", str(i), text)

seed("options", "defaults", bytes(40))
seed("options", "pairs", bytes([1, 0]) + bytes(10 + 12) + bytes([2]) + struct.pack("<2i", 0, 39) + bytes([1]) + struct.pack("<2i", 10, 11))
seed("options", "all", bytes([0, 1]) + b"".join(b"\x01" + struct.pack("<i", x) for x in (2, 2000, 50, 4, 5, 9, 30, 60, 8, 2))
     + b"".join(b"\x01" + struct.pack("<d", x) for x in (1.96, -1.96, 0.01, 0.01, 0.4, 2, 3, 1, 0.3, 1, 0.1, 1)) + bytes(2))

# choice, then the grid: columns, rows, wrap; then changes. Choice 96: the whole search, too long for a seed.
seed("surface", "grid", bytes([0, 6, 6, 0]))
seed("surface", "tube", bytes([1, 8, 5, 1]))
seed("surface", "torus", bytes([0, 9, 8, 3]))
seed("surface", "rotation", bytes([2, 9, 8, 3]))
seed("surface", "references", bytes([4, 0, 40, 20, 33, 9, 8, 0]))
seed("surface", "pairs", bytes([12, 0, 40, 20, 33, 9, 8, 0]))
seed("surface", "changed", bytes([1, 8, 8, 1]) + b"".join(struct.pack("<BHb", k, 3 * k, k % 50) for k in range(60))
     + struct.pack("<BHB", 120, 7, 33) + struct.pack("<BH", 180, 9) + struct.pack("<BHff", 210, 3, 1, 2) + struct.pack("<BH3B", 240, 0, 1, 2, 9))
# choice 16: other parts, each a grid, where it is moved to and its size; then damages, each a kind and a seed.
parts = bytes([2]) + bytes([9, 6, 1]) + struct.pack("<4b", 40, 8, 0, 0) + bytes([5, 5, 3]) + struct.pack("<4b", 0, 0, 90, -2)
seed("surface", "parts", bytes([16, 9, 8, 3]) + parts + bytes([0]))
for kind in range(13):
    seed("surface", f"damage_{kind}", bytes([16, 9, 8, 3]) + (parts if kind % 2 else bytes([0])) + bytes([1, kind, 7]))
seed("surface", "damage_twice", bytes([20, 0, 40, 20, 33, 9, 8, 0]) + parts + bytes([3, 12, 1, 9, 2, 4, 3]))
seed("surface", "tiny", bytes([16, 2, 2, 0, 0, 2, 10, 1, 12, 2]))
