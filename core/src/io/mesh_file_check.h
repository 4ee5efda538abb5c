// Checks of mesh files before vcglib's importers see them; private to the core.
//
// The importers trust their input: a file cut short makes the OFF importer read past the end of its words, a polygon
// may refer to vertices that do not exist, and a count in a header is allocated as it stands. The checks walk a file as
// its importer will, and refuse what it would not survive.
#pragma once
#include <string>
#include <string_view>

#include "ga_symmetry/context.h"

namespace ga_symmetry {

/// Reports progress.
/// @param text  the whole file
/// @throws FileError  what is wrong and where, without the file's name
/// @throws Cancelled
void check_off(std::string_view text, const Context& context);
void check_ply(std::string_view text, const Context& context);

}  // namespace ga_symmetry
