// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets share: bytes become numbers, and an error that the core promises is no finding.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "ga_symmetry/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ga_symmetry::fuzz {

/// Hands out the input piece by piece; zeros when it is used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  template <class Number>
  Number take() {
    Number value{};
    const std::size_t size = left_ < sizeof value ? left_ : sizeof value;
    if (size > 0) std::memcpy(&value, data_, size);
    data_ += size, left_ -= size;
    return value;
  }
  std::string rest() const { return {reinterpret_cast<const char*>(data_), left_}; }
  bool empty() const { return left_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Runs the body; what it throws must be an error of the core with a message of one line.
template <class Body>
void expect_result_or_line(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    const std::string text = error.what();
    if (text.empty() || text.find('\n') != text.npos) std::abort();
  }
}

/// A file of one name, written anew for every input.
inline std::string as_file(const std::string& ending, const std::string& bytes) {
  static const std::string folder = [] {
    char name[] = "/tmp/ga_symmetry-fuzz-XXXXXX";
    if (!::mkdtemp(name)) std::abort();
    return std::string(name);
  }();
  std::string path = folder + "/input" + ending;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

}  // namespace ga_symmetry::fuzz
