// Comma-separated tables (RFC 4180 quoting, lines end with \n), numbers in the shortest form that reads back to the
// same bits.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::io {

/// A field as written to a file: quoted only if it contains a comma, a quote or a line end.
std::string csv_field(std::string_view text);

/// Builds a table. Every row must have as many fields as there are columns.
class CsvWriter {
 public:
  explicit CsvWriter(const std::vector<std::string>& columns);
  CsvWriter& text(std::string_view value);
  CsvWriter& number(double value);  ///< NaN: an empty field; infinities: inf, -inf
  CsvWriter& integer(long long value);
  CsvWriter& seed(unsigned long long value);
  CsvWriter& empty();
  void end_row();
  const std::string& str() const { return text_; }

 private:
  void separate();

  std::size_t columns_;
  std::size_t filled_ = 0;
  std::string text_;
};

/// A table read from text. Errors are ConfigErrors that name file and line.
class CsvTable {
 public:
  /// The first line names the columns; a byte order mark before it is skipped. Those in `required` must exist, in any
  /// order.
  CsvTable(std::string bytes, std::filesystem::path file, const std::vector<std::string>& required = {});

  std::size_t rows() const { return lines_.size(); }
  int line(std::size_t row) const { return static_cast<int>(lines_[row]); }  ///< line number at which a row begins
  const std::vector<std::string>& columns() const { return columns_; }
  bool has(std::string_view column) const;
  std::string text(std::size_t row, std::string_view name) const;
  std::string_view field(std::size_t row, std::string_view name) const;   ///< its bytes, as long as the table exists
  std::string folder_name(std::size_t row, std::string_view name) const;  ///< refuses what is no FolderName
  double number(std::size_t row, std::string_view name) const;            ///< NaN for an empty field
  std::optional<double> optional_number(std::size_t row, std::string_view name) const;  ///< nullopt for an empty field
  long long integer(std::size_t row, std::string_view name) const;
  int index(std::size_t row, std::string_view name) const;  ///< an integer that fits an int
  [[noreturn]] void refuse(std::size_t row, const std::string& message) const;

 private:
  /// A field's bytes. Indices, because a table that is moved keeps them.
  struct Field {
    std::size_t begin;
    std::size_t size;
  };

  std::size_t column(std::string_view name) const;
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;

  std::filesystem::path file_;
  std::string bytes_;  ///< of the whole file; quoted fields are replaced by their text
  std::vector<std::string> columns_;
  std::vector<Field> fields_;       ///< row by row, without the header
  std::vector<std::size_t> lines_;  ///< line number at which each row begins
};

}  // namespace scanbench::io
