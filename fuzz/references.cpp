// SPDX-License-Identifier: GPL-3.0-or-later
// References as the user types them.
#include <cstdlib>

#include "fuzz.h"
#include "ga_symmetry/symmetry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ga_symmetry;
  const std::string text = fuzz::Bytes(data, size).rest();
  fuzz::expect_result_or_line([&] {
    const References references = parse_references(text);
    for (const int v : references.axis)
      if (v < 0) std::abort();
    for (const auto& [l, r] : references.pairs)
      if (l < 0 || r < 0 || l == r) std::abort();
  });
  return 0;
}
