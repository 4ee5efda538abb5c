// SPDX-License-Identifier: GPL-3.0-or-later
// Files, lines, words and numbers of text held in memory; private to the project. Nothing depends on the locale.
#pragma once
#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "ga_symmetry/errors.h"

namespace ga_symmetry {

/// The whole file, which must not be empty; a device or a pipe might never end.
/// @throws FileError  the reason, without the file's name
std::string read_text(const std::string& path);

/// A number that std::from_chars calls out of range, as strtod has it: 0 or infinite.
template <class Real>
Real beyond_range(const std::string& word);
template <>
float beyond_range(const std::string& word);
template <>
double beyond_range(const std::string& word);

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

/// Walks over a text in one pass, from word to word; parsing many numbers needs no copies.
class TextScanner {
 public:
  static constexpr char kNoComments = '\n';
  /// @param comment  begins what is skipped to the end of the line
  /// @param line     number of the text's first line
  explicit TextScanner(std::string_view text, char comment = kNoComments, long line = 1)
      : at_(text.data()), end_(text.data() + text.size()), comment_(comment), line_(line) {}

  /// Goes to the next word of this line, if there is one; to the end of the line if not.
  bool next_in_line() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    if (at_ != end_ && *at_ == comment_ && *at_ != '\n') to_line_end();
    return at_ != end_ && *at_ != '\n';
  }
  /// Goes to the next word, if there is one: in this line or a later one.
  bool next() {
    while (!next_in_line())
      if (!next_line()) return false;
    return true;
  }
  /// Goes to the beginning of the next line, if there is one.
  bool next_line() {
    to_line_end();
    if (at_ != end_) ++at_;
    if (at_ == end_) return false;
    ++line_;
    return true;
  }
  /// The word that begins here.
  std::string_view word() const {
    const char* to = at_;
    while (to != end_ && !ends_word(*to)) ++to;
    return {at_, static_cast<std::size_t>(to - at_)};
  }
  void drop_word() {
    while (at_ != end_ && !ends_word(*at_)) ++at_;
  }
  void drop(std::size_t bytes) { at_ += bytes; }
  /// Reads the word here as a number, to 0 or infinite if a real one is out of range; stays if it is none.
  template <class Number>
  bool read(Number& value) {
    const char* from = at_;
    if (end_ - from > 1 && *from == '+' && from[1] != '-') ++from;
    const auto [to, error] = std::from_chars(from, end_, value);
    if (to == from || (to != end_ && !ends_word(*to))) return false;
    if (error != std::errc()) {
      if constexpr (std::is_floating_point_v<Number>)
        value = beyond_range<Number>(std::string(from, to));
      else
        return false;
    }
    at_ = to;
    return true;
  }
  long line() const { return line_; }  ///< from 1
  std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); }
  bool ends_word(char c) const { return is_blank(c) || c == '\n' || c == comment_; }
  void to_line_end() {
    const void* found = at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    at_ = found ? static_cast<const char*>(found) : end_;
  }
  const char* at_;
  const char* end_;
  char comment_;
  long line_;
};

}  // namespace ga_symmetry
