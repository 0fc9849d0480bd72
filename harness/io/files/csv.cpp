// Writes and reads comma-separated tables (RFC 4180).
#include "harness/io/files/csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/csv_rows.hpp"
#include "harness/io/files/folder_name.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {

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

CsvTable::CsvTable(std::string bytes, std::filesystem::path file, const std::vector<std::string>& required)
    : file_(std::move(file)), bytes_(std::move(bytes)) {
  CsvRows rows(bytes_, file_, required);
  columns_ = rows.columns();
  const auto most = static_cast<std::size_t>(std::ranges::count(bytes_, '\n')) + 1;  // fewer if fields have line ends
  lines_.reserve(most);
  fields_.reserve(most * columns_.size());
  while (rows.next()) {
    lines_.push_back(rows.line());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string_view field = rows.text();
      fields_.push_back({static_cast<std::size_t>(field.data() - bytes_.data()), field.size()});
    }
  }
}

void CsvTable::fail(std::size_t line, const std::string& message) const {
  throw ConfigError(file_.string() + ":" + std::to_string(line) + ": " + message);
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
  fail(lines_[row], message);
}

std::string CsvTable::text(std::size_t row, std::string_view name) const {
  return std::string(field(row, name));
}

std::string CsvTable::folder_name(std::size_t row, std::string_view name) const {
  const std::string found = text(row, name);
  try {
    return check_name(std::string(name), found).text();
  } catch (const ConfigError& error) {
    refuse(row, error.what());
  }
}

std::string_view CsvTable::field(std::size_t row, std::string_view name) const {
  const Field& field = fields_[row * columns_.size() + column(name)];
  return std::string_view(bytes_).substr(field.begin, field.size);
}

std::optional<double> CsvTable::optional_number(std::size_t row, std::string_view name) const {
  const std::string_view text = field(row, name);
  if (text.empty()) return std::nullopt;
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  const auto value = parse_number(text);
  if (!value)
    refuse(row, std::string(name) + " is " + quoted_excerpt(text) + "; allowed: a number, inf, -inf, nothing");
  return value;
}

double CsvTable::number(std::size_t row, std::string_view name) const {
  return optional_number(row, name).value_or(std::numeric_limits<double>::quiet_NaN());
}

long long CsvTable::integer(std::size_t row, std::string_view name) const {
  const std::string_view text = field(row, name);
  const auto value = parse_integer(text);
  if (!value) refuse(row, std::string(name) + " is " + quoted_excerpt(text) + "; allowed: a whole number");
  return *value;
}

int CsvTable::index(std::size_t row, std::string_view name) const {
  const long long value = integer(row, name);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    refuse(row, std::string(name) + " is " + std::to_string(value) + ", which is out of range");
  return static_cast<int>(value);
}

}  // namespace scanbench::io
