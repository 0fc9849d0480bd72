// docs/modules.md has the program's own description of its modules, and docs/write-a-module.md names every helper.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "harness/results/figures/catalog.hpp"
#include "tests/support/places.hpp"

namespace scanbench {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(places::source_dir() / file);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The first groups of all matches.
std::set<std::string> names_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

TEST(ModulesDocument, IsWhatDescribeAllPrints) {
  EXPECT_EQ(text_of("docs/modules.md"), results::catalog_markdown(results::catalog()))
      << "write it again: ./scanbench describe --all --format markdown > docs/modules.md";
}

TEST(GuideToModules, NamesEveryHelperForParameters) {
  std::set<std::string> helpers = names_in(text_of("core/params.hpp"), "(?:inline Bounds|Field<P, \\w+>) (\\w+)\\(");
  EXPECT_TRUE(helpers.contains("degrees_field") && helpers.contains("above")) << "the pattern no longer fits";
  const std::size_t of_core = helpers.size();
  for (const std::string folder : {"algorithms/extract/parts", "algorithms/merge/parts"})
    for (const auto& entry : fs::directory_iterator(places::source_dir() / folder))
      if (entry.path().extension() == ".hpp") helpers.merge(names_in(text_of(entry.path()), "auto (\\w+_fields?)\\("));
  EXPECT_GT(helpers.size(), of_core + 5);
  const std::string guide = text_of("docs/write-a-module.md");
  for (const auto& helper : helpers)
    EXPECT_TRUE(std::regex_search(guide, std::regex("`" + helper + "[`(]"))) << helper << " is not in the guide";
}

TEST(GuideToModules, IsTwoPagesAndEndsWithTheCommandThatTestsTheModule) {
  const std::string guide = text_of("docs/write-a-module.md");
  EXPECT_LE(std::count(guide.begin(), guide.end(), '\n'), 130);
  EXPECT_TRUE(guide.ends_with("```\n./scanbench test --module my_lines\n```\n"));
}

}  // namespace
}  // namespace scanbench
