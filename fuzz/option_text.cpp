// SPDX-License-Identifier: GPL-3.0-or-later
// Advanced options as the user types them: refused in one line, or set to what may be.
#include <cstdlib>

#include "fuzz.h"
#include "ga_symmetry/option_table.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ga_symmetry;
  const std::string text = fuzz::Bytes(data, size).rest();
  fuzz::expect_result_or_line([&] {
    Options options;
    set_expert_options(options, text);
    if (options.joint.sites < options.joint.samples) return;  // each is in its own range
    try {
      check_options(options);
    } catch (const InvalidOption&) {
      std::abort();
    }
  });
  return 0;
}
