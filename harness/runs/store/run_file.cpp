// The files of a run, as their writers name them.
#include "harness/runs/store/run_file.hpp"

#include <algorithm>
#include <vector>

#include "core/registry.hpp"
#include "metrics/metric.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

std::vector<std::string_view>& patterns() {
  static std::vector<std::string_view> all;
  return all;
}

std::string_view last_part(std::string_view path) {
  return path.substr(path.rfind('/') + 1);  // npos + 1 is 0
}

/// Does the text match, where `*` is any number of characters other than '/'?
bool matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() != '*')
    return !text.empty() && text.front() == pattern.front() && matches(pattern.substr(1), text.substr(1));
  const std::string_view rest = pattern.substr(1);
  for (std::size_t skipped = 0;; ++skipped) {
    if (matches(rest, text.substr(skipped))) return true;
    if (skipped == text.size() || text[skipped] == '/') return false;
  }
}

/// Is there a pattern of a file in this folder or below it?
bool holds(std::string_view pattern, std::string_view folder) {
  for (std::size_t end = pattern.find('/'); end != std::string_view::npos; end = pattern.find('/', end + 1))
    if (matches(pattern.substr(0, end), folder)) return true;
  return false;
}

}  // namespace

RunFile::RunFile(std::string_view pattern) : pattern_(pattern) {
  patterns().push_back(pattern);
}

std::string RunFile::name() const {
  return std::string(last_part(pattern_));
}

fs::path operator/(const fs::path& folder, const RunFile& file) {
  return folder / file.name();
}

std::set<std::string> metric_table_files() {
  std::set<std::string> files;
  for (const auto& family : Registry<metrics::MetricFamily>::names())
    for (const auto& table : Registry<metrics::MetricFamily>::make(family, {})->table_names())
      files.insert(table + ".csv");
  return files;
}

bool is_run_file(const fs::path& relative) {
  const std::string path = relative.generic_string();
  if (std::ranges::any_of(patterns(), [&](std::string_view pattern) { return matches(pattern, path); })) return true;
  static const std::set<std::string> tables = metric_table_files();
  return matches("cells/*/*/*/*.csv", path) && tables.contains(std::string(last_part(path)));
}

bool holds_run_files(const fs::path& relative) {
  const std::string path = relative.generic_string();
  return std::ranges::any_of(patterns(), [&](std::string_view pattern) { return holds(pattern, path); });
}

}  // namespace scanbench::runs
