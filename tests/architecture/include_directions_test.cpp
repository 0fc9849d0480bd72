// Who may include whom: every #include "folder/..." of the project against a table. The picture of
// docs/architecture.md, checked.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kAllowed = {
    {"core", {"core"}},
    {"sim", {"core", "sim"}},
    {"algorithms", {"core", "algorithms"}},
    {"metrics", {"core", "metrics"}},
    {"render", {"core", "render"}},
    {"harness", {"core", "sim", "metrics", "render", "harness"}},
    {"app", {"core", "sim", "metrics", "render", "harness", "app"}},
};

// Headers of a library that only one folder may name.
const std::map<std::string, std::string> kOwned = {
    {"box2d/", "sim"}, {"GL/", "render"},       {"cairo", "render"},    {"yaml-cpp/", "harness"},
    {"CLI/", "app"},   {"openssl/", "harness"}, {"Random123/", "core"},
};

const std::set<std::string> kTruthHeaders = {"core/truth.hpp", "core/recording.hpp"};

template <class Check>
void for_each_include(const std::string& folder, const Check& check) {
  const std::regex include(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
  for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder)) {
    const auto ending = entry.path().extension();
    if (ending != ".cpp" && ending != ".hpp") continue;
    std::ifstream file(entry.path());
    std::string line;
    std::smatch match;
    while (std::getline(file, line))
      if (std::regex_search(line, match, include)) check(entry.path().string(), match[1].str());
  }
}

TEST(Architecture, FoldersIncludeOnlyWhatLiesBelowThem) {
  int seen = 0;
  for (const auto& [folder, allowed] : kAllowed) {
    for_each_include(folder, [&](const std::string& file, const std::string& header) {
      const std::string root = header.substr(0, header.find('/'));
      if (!kAllowed.contains(root) || header.find('/') == std::string::npos) return;
      ++seen;
      EXPECT_TRUE(allowed.contains(root)) << file << " includes " << header;
    });
  }
  EXPECT_GT(seen, 50) << "the test no longer finds the project's includes";
}

TEST(Architecture, NoAlgorithmCanSeeTheTruth) {
  for_each_include("algorithms", [](const std::string& file, const std::string& header) {
    EXPECT_FALSE(kTruthHeaders.contains(header)) << file << " includes " << header;
  });
  // ... nor through a header that it may include.
  for (const char* header : {"scan.hpp", "modules.hpp", "line_map.hpp", "result.hpp", "registry.hpp", "trace.hpp"}) {
    std::ifstream file(scanbench::places::source_dir() / "core" / header);
    ASSERT_TRUE(file) << header;
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    for (const auto& truth : kTruthHeaders)
      EXPECT_EQ(text.find(truth), std::string::npos) << header << " includes " << truth;
  }
}

TEST(Architecture, LibrariesAppearInOneFolderEach) {
  for (const auto& [folder, allowed] : kAllowed) {
    for_each_include(folder, [&](const std::string& file, const std::string& header) {
      for (const auto& [prefix, owner] : kOwned)
        if (header.starts_with(prefix)) {
          EXPECT_EQ(folder, owner) << file << " includes " << header;
        }
    });
  }
}

TEST(Architecture, RandomnessComesFromTheCounterBasedGeneratorOnly) {
  const std::regex forbidden(R"(std::(random_device|mt19937|normal_distribution|uniform_\w+_distribution|rand)\b)");
  for (const auto& [folder, allowed] : kAllowed) {
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder)) {
      const auto ending = entry.path().extension();
      if (ending != ".cpp" && ending != ".hpp") continue;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      EXPECT_FALSE(std::regex_search(text, forbidden)) << entry.path();
    }
  }
}

}  // namespace
