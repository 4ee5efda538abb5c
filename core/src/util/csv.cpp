// SPDX-License-Identifier: GPL-3.0-or-later
#include "util/csv.h"

#include <charconv>

namespace ga_symmetry {
namespace {

class Digits {
 public:
  template <class Number>
  explicit Digits(Number value) : end_(std::to_chars(text_, text_ + sizeof text_, value).ptr) {}
  std::string_view text() const { return {text_, static_cast<std::size_t>(end_ - text_)}; }

 private:
  char text_[32];  // the longest double has 24 characters
  const char* end_;
};

}  // namespace

std::string number_text(int value) { return std::string(Digits(value).text()); }
std::string number_text(double value) { return std::string(Digits(value).text()); }

std::string csv_cell(std::string_view text) {
  const bool quote = text.find_first_of(",\"") != text.npos;
  std::string out(quote ? "\"" : "");
  for (char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return quote ? out + '"' : out;
}

CsvWriter::CsvWriter(std::string_view header) : text_(header) {
  if (!text_.empty()) end_row();
}

CsvWriter& CsvWriter::cell(int value) { return append(Digits(value).text()); }
CsvWriter& CsvWriter::cell(double value) { return append(Digits(value).text()); }
CsvWriter& CsvWriter::cell(std::string_view text) { return append(csv_cell(text)); }

CsvWriter& CsvWriter::append(std::string_view cell) {
  if (!row_begins_) text_ += ',';
  row_begins_ = false;
  text_ += cell;
  return *this;
}

void CsvWriter::end_row() {
  text_ += '\n';
  row_begins_ = true;
}

}  // namespace ga_symmetry
