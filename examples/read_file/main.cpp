// SPDX-License-Identifier: GPL-3.0-or-later
// read_file MESH PARTNERS.csv: reads a mesh, writes the partners of its vertices; without vcglib.
#include <ga_symmetry/io.h>
#include <ga_symmetry/symmetry.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const ga_symmetry::TriangleMesh mesh = ga_symmetry::read_mesh(argv[1]);
  ga_symmetry::Options options;  // automatic; options.references are vertices that you know
  const ga_symmetry::Result result = ga_symmetry::find_symmetry(mesh, options);
  ga_symmetry::write_result(argv[2], mesh, result);
  std::printf("%d of %d vertices have a partner\n", result.matched, mesh.vertices());
} catch (const ga_symmetry::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
