// Writes and reads comma-separated tables (RFC 4180).
#include "harness/files/csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace scanbench::harness {

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted.push_back('"');
    quoted.push_back(c);
  }
  return quoted + "\"";
}

CsvWriter::CsvWriter(const std::vector<std::string>& columns) : columns_(columns.size()) {
  for (const auto& column : columns) text(column);
  end_row();
}

void CsvWriter::separate() {
  if (filled_++ > 0) text_.push_back(',');
}

CsvWriter& CsvWriter::text(std::string_view value) {
  separate();
  text_ += csv_field(value);
  return *this;
}

CsvWriter& CsvWriter::number(double value) {
  separate();
  if (!std::isnan(value)) text_ += number_text(value);
  return *this;
}

CsvWriter& CsvWriter::integer(long long value) {
  separate();
  text_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::seed(unsigned long long value) {
  separate();
  text_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::empty() {
  separate();
  return *this;
}

void CsvWriter::end_row() {
  SCANBENCH_ASSERT(filled_ == columns_);
  text_.push_back('\n');
  filled_ = 0;
}

CsvTable::CsvTable(std::string_view bytes, std::filesystem::path file, const std::vector<std::string>& required)
    : file_(std::move(file)) {
  const auto fail = [&](std::size_t line, const std::string& message) {
    throw ConfigError(file_.string() + ":" + std::to_string(line) + ": " + message);
  };
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  std::vector<std::string> row;
  std::size_t line = 1;
  std::size_t i = 0;
  bool has_header = false;
  while (i < bytes.size()) {
    const std::size_t start = line;
    row.clear();
    for (bool more = true; more;) {
      std::string field;
      if (i < bytes.size() && bytes[i] == '"') {
        for (++i;; ++i) {
          if (i >= bytes.size()) fail(start, "a quote is not closed");
          if (bytes[i] == '\n') ++line;
          if (bytes[i] == '"' && (i + 1 >= bytes.size() || bytes[i + 1] != '"')) break;
          if (bytes[i] == '"') ++i;
          field.push_back(bytes[i]);
        }
        ++i;
      } else {
        const std::size_t end = std::min(bytes.find_first_of(",\r\n\"", i), bytes.size());
        field = bytes.substr(i, end - i);
        i = end;
      }
      row.push_back(std::move(field));
      if (i < bytes.size() && bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n') ++i;
      more = i < bytes.size() && bytes[i] == ',';
      if (i < bytes.size() && !more && bytes[i] != '\n') fail(line, "a comma or the end of the line is missing");
      ++i;
    }
    ++line;
    if (!has_header) {
      columns_ = row;
      has_header = true;
    } else if (row.size() != columns_.size()) {
      fail(start, "found " + std::to_string(row.size()) + " fields; the first line names " +
                      std::to_string(columns_.size()) + " columns");
    } else {
      rows_.push_back(row);
      lines_.push_back(start);
    }
  }
  const bool semicolons = columns_.size() == 1 && columns_.front().find(';') != std::string::npos;
  const std::string hint = semicolons ? "; allowed: commas between the fields, not semicolons" : "";
  for (const auto& name : required)
    if (!has(name)) fail(1, "the column '" + name + "' is missing" + hint);
}

bool CsvTable::has(std::string_view column) const {
  return std::ranges::find(columns_, column) != columns_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(columns_, name);
  if (found == columns_.end())
    throw ConfigError(file_.string() + ": the column '" + std::string(name) + "' is missing");
  return static_cast<std::size_t>(found - columns_.begin());
}

void CsvTable::refuse(std::size_t row, const std::string& message) const {
  throw ConfigError(file_.string() + ":" + std::to_string(lines_[row]) + ": " + message);
}

const std::string& CsvTable::text(std::size_t row, std::string_view name) const {
  return rows_[row][column(name)];
}

std::optional<double> CsvTable::optional_number(std::size_t row, std::string_view name) const {
  const std::string& field = text(row, name);
  if (field.empty()) return std::nullopt;
  if (field == "inf") return std::numeric_limits<double>::infinity();
  if (field == "-inf") return -std::numeric_limits<double>::infinity();
  const auto value = parse_number(field);
  if (!value) refuse(row, std::string(name) + " is '" + field + "'; allowed: a number, inf, -inf, nothing");
  return value;
}

double CsvTable::number(std::size_t row, std::string_view name) const {
  return optional_number(row, name).value_or(std::numeric_limits<double>::quiet_NaN());
}

long long CsvTable::integer(std::size_t row, std::string_view name) const {
  const std::string& field = text(row, name);
  const auto value = parse_integer(field);
  if (!value) refuse(row, std::string(name) + " is '" + field + "'; allowed: a whole number");
  return *value;
}

int CsvTable::index(std::size_t row, std::string_view name) const {
  const long long value = integer(row, name);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    refuse(row, std::string(name) + " is " + std::to_string(value) + ", which is out of range");
  return static_cast<int>(value);
}

}  // namespace scanbench::harness
