// Reads comma-separated tables (RFC 4180) field by field, without keeping them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::io {

/// Errors are ConfigErrors that name file and line.
class CsvRows {
 public:
  /// The first line names the columns; a byte order mark before it is skipped. Those in `required` must exist, in any
  /// order. `bytes` must remain and is changed: quoted fields are replaced by their text.
  CsvRows(std::string& bytes, std::filesystem::path file, const std::vector<std::string>& required = {});

  const std::vector<std::string>& columns() const { return columns_; }

  /// Goes to the next row; false at the end. Every field of the row before it must have been read.
  bool next();
  std::size_t line() const { return start_; }  ///< line number at which the row begins
  /// The bytes of the row's next field.
  std::string_view text();
  /// The row's next field as a finite number (parse_number()).
  double number();

  [[noreturn]] void refuse(std::size_t line, const std::string& message) const;

 private:
  std::string_view read_field();
  bool more_fields();
  void end_field(bool more);

  std::string& bytes_;
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::size_t next_ = 0;  ///< place in the bytes
  std::size_t line_ = 1;  ///< of that place
  std::size_t start_ = 1;
  std::size_t read_ = 0;  ///< fields of the row
};

}  // namespace scanbench::io
