// Advanced options as the user types them: refused in one line, or set.
#include "option_text.h"

#include <cstdlib>

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ga_symmetry;
  const std::string text = fuzz::Bytes(data, size).rest();
  fuzz::expect_result_or_line([&] {
    Options options;
    set_options(text, options);
    if (options.pairs.error != PairError::squared && options.pairs.error != PairError::linear) std::abort();
    if (options.pairs.sampling != Sampling::evenly_spaced && options.pairs.sampling != Sampling::uniform) std::abort();
  });
  return 0;
}
