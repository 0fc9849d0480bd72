// Reads comma-separated tables field by field.
#include "harness/io/files/csv_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

bool ends_field(char c) {
  return c == ',' || c == '\n' || c == '\r' || c == '"';
}

}  // namespace

CsvRows::CsvRows(std::string& bytes, std::filesystem::path file, const std::vector<std::string>& required)
    : bytes_(bytes), file_(std::move(file)) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes_.starts_with(kByteOrderMark)) next_ = kByteOrderMark.size();
  for (bool more = next_ < bytes_.size(); more;) {
    columns_.emplace_back(read_field());
    more = more_fields();
  }
  const bool semicolons = columns_.size() == 1 && columns_.front().find(';') != std::string::npos;
  const std::string hint = semicolons ? "; allowed: commas between the fields, not semicolons" : "";
  for (const auto& name : required)
    if (std::ranges::find(columns_, name) == columns_.end()) refuse(1, "the column '" + name + "' is missing" + hint);
}

bool CsvRows::next() {
  SCANBENCH_ASSERT(start_ == 1 || read_ == columns_.size());
  start_ = line_;
  read_ = 0;
  return next_ < bytes_.size();
}

std::string_view CsvRows::text() {
  const std::string_view field = read_field();
  end_field(more_fields());
  return field;
}

double CsvRows::number() {
  // One pass over a field that is not quoted; text() and parse_number() would take two.
  const char* const begin = bytes_.data() + next_;
  const char* const end_of_file = bytes_.data() + bytes_.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, end_of_file, value);
  if (error == std::errc{} && std::isfinite(value) && (end == end_of_file || ends_field(*end))) {
    next_ = static_cast<std::size_t>(end - bytes_.data());
    end_field(more_fields());
    return value;
  }
  const std::string_view field = text();
  const auto parsed = parse_number(field);
  if (!parsed) refuse(start_, columns_[read_ - 1] + " is " + quoted_excerpt(field) + "; allowed: a number");
  return *parsed;
}

/// Reads the field that begins at `next_`, and moves `next_` behind it.
std::string_view CsvRows::read_field() {
  const std::size_t begin = next_;
  if (next_ >= bytes_.size() || bytes_[next_] != '"') {
    while (next_ < bytes_.size() && !ends_field(bytes_[next_])) ++next_;
    return std::string_view(bytes_).substr(begin, next_ - begin);
  }
  // The text is never longer than what it replaces.
  const std::size_t start = line_;
  std::size_t end = begin;
  for (++next_;; ++next_) {
    if (next_ >= bytes_.size()) refuse(start, "a quote is not closed");
    if (bytes_[next_] == '\n') ++line_;
    if (bytes_[next_] == '"' && (next_ + 1 >= bytes_.size() || bytes_[next_ + 1] != '"')) break;
    if (bytes_[next_] == '"') ++next_;
    bytes_[end++] = bytes_[next_];
  }
  ++next_;
  return std::string_view(bytes_).substr(begin, end - begin);
}

/// Moves behind the comma or line end after a field; true after a comma.
bool CsvRows::more_fields() {
  if (next_ + 1 < bytes_.size() && bytes_[next_] == '\r' && bytes_[next_ + 1] == '\n') ++next_;
  const bool more = next_ < bytes_.size() && bytes_[next_] == ',';
  if (next_ < bytes_.size() && !more && bytes_[next_] != '\n')
    refuse(line_, "a comma or the end of the line is missing");
  ++next_;
  if (!more) ++line_;
  return more;
}

/// Refuses a row that has another number of fields than there are columns.
void CsvRows::end_field(bool more) {
  ++read_;
  if (more == (read_ < columns_.size())) return;
  std::size_t found = read_;
  for (; more; ++found) {
    read_field();
    more = more_fields();
  }
  refuse(start_, "found " + std::to_string(found) + " fields; the first line names " + std::to_string(columns_.size()) +
                     " columns");
}

void CsvRows::refuse(std::size_t line, const std::string& message) const {
  throw ConfigError(file_.string() + ":" + std::to_string(line) + ": " + message);
}

}  // namespace scanbench::io
