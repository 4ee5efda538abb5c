// SPDX-License-Identifier: GPL-3.0-or-later
// use_core MESH.off: the partners of a vcglib mesh's vertices, without references.
#include <ga_symmetry/symmetry.h>
#include <vcg/complex/complex.h>
#include <wrap/io_trimesh/import_off.h>

#include <cstdio>

class Vertex;
class Face;
struct Types : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
class Vertex : public vcg::Vertex<Types, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::BitFlags> {};
class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::BitFlags> {};
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

int main(int argc, char** argv) try {
  Mesh mesh;
  int mask = 0;
  if (argc != 2 || vcg::tri::io::ImporterOFF<Mesh>::Open(mesh, argv[1], mask) != 0) return 2;
  const ga_symmetry::Result result = ga_symmetry::find_symmetry(ga_symmetry::to_triangle_mesh(mesh));
  for (std::size_t v = 0; v < result.partners.partner.size(); ++v)
    std::printf("%zu %d\n", v, result.partners.partner[v]);
} catch (const ga_symmetry::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
