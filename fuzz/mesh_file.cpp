// Mesh files: the first byte chooses the ending, the rest is the file.
#include <cstdlib>

#include "fuzz.h"
#include "ga_symmetry/io.h"
#include "ga_symmetry/mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ga_symmetry;
  constexpr const char* kEndings[] = {".off", ".ply", ".obj", ".stl"};
  if (size == 0) return 0;
  const std::string path = fuzz::as_file(kEndings[data[0] % 4], fuzz::Bytes(data + 1, size - 1).rest());
  fuzz::expect_result_or_line([&] {
    const TriangleMesh mesh = read_mesh(path);
    if (mesh.position.size() % 3 || mesh.triangle.size() % 3) std::abort();
    for (const int v : mesh.triangle)
      if (v < 0 || v >= mesh.vertices()) std::abort();
  });
  return 0;
}
