// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the core: one type per remedy. Poor symmetry is a result, not an error.
#pragma once
#include <stdexcept>
#include <string>

namespace ga_symmetry {

/// Base of all errors that the core throws on purpose; `what()` is one line that names the remedy.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The mesh cannot be worked on; repair the mesh.
struct InvalidMesh : Error {
  using Error::Error;
};
/// An option or a reference is out of its range; change the call.
struct InvalidOption : Error {
  using Error::Error;
};
/// A file cannot be read or written.
struct FileError : Error {
  using Error::Error;
};
/// The caller asked to stop; nothing was changed.
struct Cancelled : Error {
  Cancelled() : Error("cancelled") {}
};

}  // namespace ga_symmetry
