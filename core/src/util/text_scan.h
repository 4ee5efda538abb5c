// Lines, words and numbers of a text file held in memory; private to the project. Nothing depends on the locale.
#pragma once
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

/// The whole file; a device or a pipe might never end. @throws FileError  the reason, without the file's name
inline std::string read_text(const std::string& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
    throw FileError("it is missing, empty or not a file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) throw FileError("it is missing, empty or not a file");
  return text.str();
}

/// The whole word as a number; a leading + is allowed. Nothing if it is not one or does not fit.
template <class Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

inline std::vector<std::string_view> split(std::string_view line, std::string_view separators = " \t\r\n\f\v") {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(separators, at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

/// For a message, which is one line: the first 40 characters in quotes, blanks for white space, ? for what is not
/// printable ASCII.
inline std::string quoted(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out) {
    if (c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return '"' + out + '"';
}

/// Hands out one line after the other, without its \n.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    ++number_;
    return true;
  }
  long number() const { return number_; }  ///< of the line handed out last, from 1
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  long number_ = 0;
};

}  // namespace ga_symmetry
