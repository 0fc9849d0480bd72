// Writes and reads comma-separated tables (RFC 4180).
#include "harness/files/csv.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/files/text_file.hpp"

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

namespace {

bool ends_field(char c) {
  return c == ',' || c == '\n' || c == '\r' || c == '"';
}

}  // namespace

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
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::size_t line = 1;
  std::size_t i = bytes_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  bool has_header = false;
  while (i < bytes_.size()) {
    const std::size_t start = line;
    const std::size_t first = fields_.size();
    for (bool more = true; more;) {
      fields_.push_back(read_field(i, line));
      if (i + 1 < bytes_.size() && bytes_[i] == '\r' && bytes_[i + 1] == '\n') ++i;
      more = i < bytes_.size() && bytes_[i] == ',';
      if (i < bytes_.size() && !more && bytes_[i] != '\n') fail(line, "a comma or the end of the line is missing");
      ++i;
    }
    ++line;
    if (!has_header) {
      columns_ = names();
      fields_.clear();
      has_header = true;
    } else if (fields_.size() - first != columns_.size()) {
      fail(start, "found " + std::to_string(fields_.size() - first) + " fields; the first line names " +
                      std::to_string(columns_.size()) + " columns");
    } else {
      lines_.push_back(start);
    }
  }
  const bool semicolons = columns_.size() == 1 && columns_.front().find(';') != std::string::npos;
  const std::string hint = semicolons ? "; allowed: commas between the fields, not semicolons" : "";
  for (const auto& name : required)
    if (!has(name)) fail(1, "the column '" + name + "' is missing" + hint);
}

/// Reads the field that begins at `next`, and moves `next` behind it. `line` grows by the line ends in it.
CsvTable::Field CsvTable::read_field(std::size_t& next, std::size_t& line) {
  if (next >= bytes_.size() || bytes_[next] != '"') {
    const std::size_t begin = next;
    while (next < bytes_.size() && !ends_field(bytes_[next])) ++next;
    return {begin, next - begin};
  }
  // The text is never longer than what it replaces.
  const std::size_t start = line;
  const std::size_t begin = next;
  std::size_t end = begin;
  for (++next;; ++next) {
    if (next >= bytes_.size()) fail(start, "a quote is not closed");
    if (bytes_[next] == '\n') ++line;
    if (bytes_[next] == '"' && (next + 1 >= bytes_.size() || bytes_[next + 1] != '"')) break;
    if (bytes_[next] == '"') ++next;
    bytes_[end++] = bytes_[next];
  }
  ++next;
  return {begin, end - begin};
}

std::vector<std::string> CsvTable::names() const {
  std::vector<std::string> names;
  for (const Field& field : fields_) names.push_back(bytes_.substr(field.begin, field.size));
  return names;
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

}  // namespace scanbench::harness
