// Each file includes what it uses: no file counts on the headers that the build precompiles. A name of such a header
// must come with an include of it, in the file itself or in the header of the same name.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

struct Supplied {
  const char* names;   ///< the names of the header, as a regular expression
  const char* header;  ///< as written between the brackets of an include
};

// The list of cmake/targets.cmake, with the names that show a use.
const Supplied kSupplied[] = {
    {R"(std::(ranges::)?(sort|stable_sort|find|find_if|count|count_if|transform|any_of|all_of|none_of|min_element|max_element|minmax_element|lower_bound|upper_bound|reverse|copy|fill|unique|nth_element|clamp|includes)\()",
     "algorithm"},
    {R"(std::(ranges::)?(min|max)\()", "algorithm"},
    {R"(std::(sqrt|hypot|atan2|sin|cos|isnan|isfinite|isinf|floor|ceil|abs|pow|exp|log|round|lround)\()", "cmath"},
    {R"(std::filesystem\b)", "filesystem"},
    {R"(std::function<)", "functional"},
    {R"(std::map<)", "map"},
    {R"(std::(unique_ptr|make_unique)\b)", "memory"},
    {R"(std::(optional|nullopt)\b)", "optional"},
    {R"(std::span\b)", "span"},
    {R"(std::(string|to_string)\b)", "string"},
    {R"(std::vector<)", "vector"},
    {R"(fmt::(format|join|print)\b)", "fmt/"},
    {R"(nlohmann::)", "nlohmann/json"},  // json.hpp, or json_fwd.hpp in headers
    {R"(CLI::)", "CLI/"},
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

/// The text of the file and of every project header that it includes, at any depth.
std::string with_headers(const fs::path& file, std::set<std::string>& seen) {
  std::string text = text_of(file);
  static const std::regex include("#include \"([^\"]+)\"");
  std::string all = text;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
    const std::string header = (*it)[1];
    const fs::path path = scanbench::places::source_dir() / header;
    if (fs::exists(path) && seen.insert(header).second) all += with_headers(path, seen);
  }
  return all;
}

TEST(Includes, NoFileCountsOnPrecompiledHeaders) {
  int checked = 0;
  for (const std::string top : {"core", "sim", "algorithms", "metrics", "render", "harness", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / top)) {
      const auto ending = entry.path().extension();
      if (ending != ".cpp" && ending != ".hpp") continue;
      std::set<std::string> seen;
      const std::string text = text_of(entry.path());
      const std::string all = with_headers(entry.path(), seen);
      for (const auto& [names, header] : kSupplied) {
        if (!std::regex_search(text, std::regex(names))) continue;
        ++checked;
        EXPECT_NE(all.find(std::string("#include <") + header), std::string::npos)
            << entry.path() << " uses a name of <" << header << "> and no header that it includes has it";
      }
    }
  }
  EXPECT_GT(checked, 1000) << "the test no longer finds what files use";
}

}  // namespace
