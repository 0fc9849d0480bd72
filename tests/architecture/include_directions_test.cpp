// Checks every #include "folder/..." of the project against a table, which is the picture in docs/architecture.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

/// A row per folder: the folders that its files may include, in addition to their own.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"core", {}},
    {"sim", {"core"}},
    {"algorithms", {"core"}},
    {"metrics", {"core"}},
    {"render", {"core"}},
    {"harness/io/files", {"core"}},
    {"harness/io/yaml", {"core", "harness/io/files"}},
    {"harness/study/conform", {"core"}},
    {"harness/io/process", {"core", "harness/io/files"}},
    {"harness/study/foreign", {"core", "harness/io/files", "harness/io/process"}},
    {"harness/io/exchange", {"core", "harness/io/files"}},
    {"harness/study/catalog", {"core", "sim", "metrics", "render", "harness/io/files", "harness/study/foreign"}},
    {"harness/study/scenario",
     {"core", "sim", "metrics", "render", "harness/io/files", "harness/io/yaml", "harness/study/foreign",
      "harness/io/exchange", "harness/study/catalog"}},
    {"harness/runs/store",
     {"core", "metrics", "harness/io/files", "harness/study/foreign", "harness/study/catalog",
      "harness/study/scenario"}},
    {"harness/runs/execute",
     {"core", "sim", "metrics", "harness/io/files", "harness/io/process", "harness/study/foreign",
      "harness/io/exchange", "harness/study/catalog", "harness/study/scenario", "harness/runs/store"}},
    {"harness/runs/sweep",
     {"core", "harness/io/files", "harness/study/scenario", "harness/runs/store", "harness/runs/execute"}},
    {"harness/results/analysis",
     {"core", "metrics", "harness/io/files", "harness/study/scenario", "harness/runs/store"}},
    {"harness/results/document", {"core", "harness/io/files"}},
    {"harness/results/figures",
     {"core", "sim", "metrics", "render", "harness/io/files", "harness/study/catalog", "harness/study/scenario",
      "harness/runs/store", "harness/results/analysis", "harness/results/document"}},
    {"harness/results/tables",
     {"core", "metrics", "harness/study/scenario", "harness/runs/store", "harness/results/analysis",
      "harness/results/document"}},
    {"harness/results/pages",
     {"core", "metrics", "harness/io/files", "harness/study/catalog", "harness/study/scenario", "harness/runs/store",
      "harness/results/analysis", "harness/results/document", "harness/results/figures", "harness/results/tables"}},
    {"harness/results/nightly",
     {"core", "metrics", "harness/io/files", "harness/study/scenario", "harness/runs/store", "harness/results/analysis",
      "harness/results/document", "harness/results/figures", "harness/results/tables", "harness/results/pages",
      "harness/results/player"}},
    {"harness/results/player",
     {"core", "render", "harness/io/files", "harness/study/scenario", "harness/runs/store", "harness/results/document",
      "harness/results/figures"}},
    {"harness/results/gallery",
     {"core", "render", "harness/io/files", "harness/io/yaml", "harness/study/scenario", "harness/runs/store",
      "harness/results/analysis", "harness/results/document", "harness/results/figures", "harness/results/tables"}},
    {"harness/results/film",
     {"core", "render", "harness/io/files", "harness/io/process", "harness/study/scenario", "harness/runs/store",
      "harness/results/document", "harness/results/figures"}},
    {"app",
     {"core",
      "render",
      "harness/io/files",
      "harness/study/conform",
      "harness/io/process",
      "harness/study/foreign",
      "harness/io/exchange",
      "harness/study/catalog",
      "harness/study/scenario",
      "harness/runs/store",
      "harness/runs/execute",
      "harness/runs/sweep",
      "harness/results/analysis",
      "harness/results/document",
      "harness/results/figures",
      "harness/results/pages",
      "harness/results/nightly",
      "harness/results/player",
      "harness/results/gallery",
      "harness/results/film"}},
};

/// A row per wing of harness/: the top folders and the wings that its files may include, in addition to their own. The
/// namespace of a wing has its name.
const std::map<std::string, std::set<std::string>> kWings = {
    {"io", {"core"}},
    {"study", {"core", "sim", "metrics", "render", "io"}},
    {"runs", {"core", "sim", "metrics", "io", "study"}},
    {"results", {"core", "sim", "metrics", "render", "io", "study", "runs"}},
};

// Headers of a library that only one folder, or one file, may name.
const std::map<std::string, std::string> kOwned = {
    {"box2d/", "sim"},
    {"GL/", "render"},
    {"cairo", "render"},
    {"CLI/", "app/options.cpp"},
    {"yaml-cpp/", "harness/io/yaml"},
    {"openssl/", "harness/io/files"},
    {"sqlite3", "harness/results/nightly"},
    {"Random123/", "core"},
    {"boost/", "core"},
    {"thread", "sim"},  // .ci/tsan runs the tests of sim only
};

/// The row of the table that a path belongs to; empty: none of the project's folders.
std::string row_of(const std::string& path) {
  for (const auto& [folder, allowed] : kAllowed)
    if (path.starts_with(folder + "/")) return folder;
  return "";
}

const std::set<std::string> kTruthHeaders = {"core/truth.hpp", "core/recording.hpp", "core/reference_poses.hpp"};

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

TEST(Architecture, FoldersIncludeOnlyWhatIsBelowThem) {
  int seen = 0;
  for (const auto& [folder, allowed] : kAllowed) {
    for_each_include(folder, [&](const std::string& file, const std::string& header) {
      const std::string row = row_of(header);
      if (row.empty()) return;
      ++seen;
      EXPECT_TRUE(row == folder || allowed.contains(row)) << file << " includes " << header;
    });
  }
  EXPECT_GT(seen, 500) << "the test no longer finds the project's includes";
}

TEST(Architecture, WingsIncludeOnlyWhatIsBelowThem) {
  std::set<std::string> wings;
  for (const auto& entry : fs::directory_iterator(scanbench::places::source_dir() / "harness"))
    wings.insert(entry.path().filename().string());
  for (const auto& wing : wings) EXPECT_TRUE(kWings.contains(wing)) << wing;
  for (const auto& [wing, allowed] : kWings) {
    int seen = 0;
    for_each_include("harness/" + wing, [&](const std::string& file, const std::string& header) {
      if (row_of(header).empty()) return;
      ++seen;
      const fs::path path = header;
      const auto top = path.begin();
      const std::string room = *top == "harness" ? std::next(top)->string() : top->string();
      EXPECT_TRUE(room == wing || allowed.contains(room)) << file << " includes " << header;
    });
    EXPECT_GT(seen, 50) << wing;
  }
}

TEST(Architecture, FilesAreInTheNamespaceOfTheirWing) {
  const std::regex opened(R"(^namespace scanbench::(\w+))");
  for (const auto& [wing, allowed] : kWings)
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / "harness" / wing)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path());
      std::smatch match;
      int seen = 0;
      for (std::string line; std::getline(file, line);)
        if (std::regex_search(line, match, opened)) {
          ++seen;
          EXPECT_EQ(match[1].str(), wing) << entry.path();
        }
      EXPECT_GT(seen, 0) << entry.path();
    }
}

TEST(Architecture, EverySourceIsInAFolderOfTheTable) {
  for (const std::string top : {"core", "sim", "algorithms", "metrics", "render", "harness", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / top)) {
      const std::string path = entry.path().lexically_relative(scanbench::places::source_dir()).generic_string();
      if (entry.is_regular_file()) {
        EXPECT_NE(row_of(path), "") << path;
      }
    }
}

TEST(Architecture, TheTableItselfHasNoCycle) {
  std::set<std::string> placed;
  for (std::size_t round = 0; round < kAllowed.size(); ++round)
    for (const auto& [folder, allowed] : kAllowed)
      if (std::ranges::includes(placed, allowed)) placed.insert(folder);
  for (const auto& [folder, allowed] : kAllowed) EXPECT_TRUE(placed.contains(folder)) << folder << " is in a cycle";
}

/// Every project header that a file includes, as paths relative to the project.
std::map<std::string, std::set<std::string>> include_graph() {
  std::map<std::string, std::set<std::string>> graph;
  for (const auto& [folder, allowed] : kAllowed)
    for_each_include(folder, [&](const std::string& file, const std::string& header) {
      const std::string from = fs::path(file).lexically_relative(scanbench::places::source_dir()).generic_string();
      if (!row_of(header).empty()) graph[from].insert(header);
    });
  return graph;
}

/// A unit is a header with its source of the same name: a.hpp and a.cpp.
std::string unit_of(const std::string& path) {
  return path.substr(0, path.rfind('.'));
}

TEST(Architecture, NoUnitsIncludeEachOther) {
  std::map<std::string, std::set<std::string>> graph;
  for (const auto& [file, headers] : include_graph())
    for (const auto& header : headers)
      if (unit_of(header) != unit_of(file)) graph[unit_of(file)].insert(unit_of(header));
  // A unit whose includes are all free of cycles is free of cycles; units that never become free are in a cycle or
  // include one.
  std::set<std::string> free_units;
  for (bool grown = true; grown;) {
    grown = false;
    for (const auto& [unit, includes] : graph) {
      const bool is_free = std::ranges::all_of(
          includes, [&](const std::string& other) { return free_units.contains(other) || !graph.contains(other); });
      if (is_free && free_units.insert(unit).second) grown = true;
    }
  }
  for (const auto& [unit, includes] : graph)
    EXPECT_TRUE(free_units.contains(unit)) << unit << " is in a cycle of includes, or includes a unit that is";
}

TEST(Architecture, FoldersAreRoomsOfAtMostTwentyFourUnits) {
  std::map<std::string, std::set<std::string>> units;
  for (const auto& [folder, allowed] : kAllowed)
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder))
      if (entry.is_regular_file())
        units[entry.path().parent_path().string()].insert(unit_of(entry.path().filename().string()));
  for (const auto& [folder, names] : units) EXPECT_LE(names.size(), 24U) << folder;
}

TEST(Architecture, EverySourceHasItsHeaderOrRegistersItself) {
  for (const auto& [folder, allowed] : kAllowed) {
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder)) {
      if (entry.path().extension() != ".cpp" || entry.path().filename() == "main.cpp") continue;
      if (fs::exists(fs::path(entry.path()).replace_extension(".hpp"))) continue;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      EXPECT_NE(text.find("SCANBENCH_REGISTER("), std::string::npos) << entry.path();
    }
  }
}

TEST(Architecture, NoAlgorithmCanSeeTheTruth) {
  for_each_include("algorithms", [](const std::string& file, const std::string& header) {
    EXPECT_FALSE(kTruthHeaders.contains(header)) << file << " includes " << header;
  });
  // ... nor through a header that it may include.
  for (const char* header :
       {"scan.hpp", "modules.hpp", "line_map.hpp", "result.hpp", "registry.hpp", "trace/trace.hpp"}) {
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
      const std::string path = fs::path(file).lexically_relative(scanbench::places::source_dir()).generic_string();
      for (const auto& [prefix, owner] : kOwned)
        if (header.starts_with(prefix)) {
          EXPECT_TRUE(path == owner || path.starts_with(owner + "/")) << file << " includes " << header;
        }
    });
  }
}

TEST(Architecture, JsonIsPrintedAndParsedInOneUnit) {
  // The others read files that are too large for a plain parse.
  const std::set<std::string> allowed_files{"json.cpp", "json_file.cpp", "manifest.cpp"};
  const std::regex costly(R"((\.|->)dump\(|[Jj]son::(sax_)?parse\()");
  for (const auto& [folder, allowed] : kAllowed) {
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder)) {
      const auto ending = entry.path().extension();
      if ((ending != ".cpp" && ending != ".hpp") || allowed_files.contains(entry.path().filename().string())) continue;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), {});
      EXPECT_FALSE(std::regex_search(text, costly)) << entry.path() << ": use harness/io/files/json.hpp";
    }
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
