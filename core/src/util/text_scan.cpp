// SPDX-License-Identifier: GPL-3.0-or-later
#include "util/text_scan.h"

#include <locale.h>

#include <cerrno>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace ga_symmetry {
namespace {

locale_t plain_locale() {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  return plain;
}

}  // namespace

std::string read_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FileError("there is no such file");
  if (!fs::is_regular_file(status)) throw FileError("it is not a file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw FileError(error.message());
  if (size == 0) throw FileError("the file is empty");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size)))
    throw FileError(errno ? std::generic_category().message(errno) : "it cannot be read");
  return text;
}

template <>
float beyond_range(const std::string& word) {
  return strtof_l(word.c_str(), nullptr, plain_locale());
}

template <>
double beyond_range(const std::string& word) {
  return strtod_l(word.c_str(), nullptr, plain_locale());
}

}  // namespace ga_symmetry
