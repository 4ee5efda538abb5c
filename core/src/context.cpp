#include "ga_symmetry/context.h"

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

void Context::report(double fraction, const char* stage) const {
  if (cancelled()) throw Cancelled();
  if (progress) progress(fraction, stage);
}

}  // namespace ga_symmetry
