// SPDX-License-Identifier: GPL-3.0-or-later
// Comma-separated tables; private to the project.
#pragma once
#include <string>
#include <string_view>

namespace ga_symmetry {

/// The shortest text that reads back as the same number, in any locale.
std::string number_text(int value);
std::string number_text(double value);

/// A cell of text in one line, in quotation marks where RFC 4180 wants them.
std::string csv_cell(std::string_view text);

/// Rows that are built cell by cell.
class CsvWriter {
 public:
  /// @param header  the names of the columns, separated by commas; "" for rows without a header
  explicit CsvWriter(std::string_view header);
  CsvWriter& cell(int value);
  CsvWriter& cell(double value);
  CsvWriter& cell(std::string_view text);
  void end_row();
  const std::string& text() const { return text_; }

 private:
  CsvWriter& append(std::string_view cell);
  std::string text_;
  bool row_begins_ = true;
};

}  // namespace ga_symmetry
