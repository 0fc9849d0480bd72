// docs/architecture.md against the tree: its picture, its table of folders, and where each library is used.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;

std::string architecture_text() {
  std::ifstream file(scanbench::places::source_dir() / "docs/architecture.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The folders that hold the program: the top ones, and those of the wings of harness/ one by one.
std::set<std::string> program_folders() {
  std::set<std::string> folders{"core", "sim", "algorithms", "metrics", "render", "app"};
  for (const auto& wing : fs::directory_iterator(scanbench::places::source_dir() / "harness"))
    for (const auto& entry : fs::directory_iterator(wing))
      folders.insert(entry.path().lexically_relative(scanbench::places::source_dir()).generic_string());
  return folders;
}

/// The cells of the rows whose head begins with `head`.
std::vector<std::vector<std::string>> table(const std::string& head) {
  std::istringstream lines(architecture_text());
  std::string line;
  while (std::getline(lines, line) && !line.starts_with(head)) continue;
  std::getline(lines, line);
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line) && line.starts_with("|")) {
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');)
      cells.push_back(std::regex_replace(cell, std::regex("^ +| +$"), ""));
    rows.push_back(cells);
  }
  return rows;
}

TEST(ArchitectureDocument, HasARowForEveryFolderOfTheProgram) {
  std::set<std::string> named;
  for (const auto& row : table("| folder |")) named.insert(row.at(0));
  for (const auto& folder : program_folders()) EXPECT_TRUE(named.contains("`" + folder + "/`")) << folder;
  for (const auto& name : named)
    EXPECT_TRUE(fs::exists(scanbench::places::source_dir() / name.substr(1, name.size() - 2))) << name;
}

TEST(ArchitectureDocument, HasEveryFolderOfTheProgramInItsPicture) {
  const std::string text = architecture_text();
  const std::size_t begin = text.find("```");
  const std::string picture = text.substr(begin, text.find("```", begin + 3) - begin);
  for (const auto& folder : program_folders()) {
    for (const auto& name : fs::path(folder))
      EXPECT_TRUE(std::regex_search(picture, std::regex("\\b" + name.string() + "\\b"))) << folder;
  }
}

TEST(ArchitectureDocument, SaysWhereEachLibraryIsUsed) {
  const std::map<std::string, std::string> headers = {{"Eigen", "Eigen/"},
                                                      {"Random123", "Random123/"},
                                                      {"Box2D", "box2d/"},
                                                      {"nanoflann", "nanoflann"},
                                                      {"libpng", "png.h"},
                                                      {"OSMesa", "GL/"},
                                                      {"Cairo, FreeType", "cairo"},
                                                      {"yaml-cpp", "yaml-cpp/"},
                                                      {"nlohmann-json", "nlohmann/"},
                                                      {"SQLite", "sqlite3.h"},
                                                      {"OpenSSL (libcrypto)", "openssl/"},
                                                      {"zlib", "zlib.h"},
                                                      {"Boost.Math", "boost/math/"},
                                                      {"Boost.Geometry", "boost/geometry"},
                                                      {"dl", "dlfcn.h"},
                                                      {"fmt", "fmt/"},
                                                      {"CLI11", "CLI/"}};
  std::map<std::string, std::set<std::string>> used;  // folders, by library
  const std::regex include(R"re(#\s*include\s*<([^>]+)>)re");
  for (const auto& folder : program_folders())
    for (const auto& entry : fs::recursive_directory_iterator(scanbench::places::source_dir() / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);)
        if (std::regex_search(line, match, include))
          for (const auto& [library, prefix] : headers)
            if (match[1].str().starts_with(prefix)) used[library].insert(folder);
    }
  std::set<std::string> listed;
  for (const auto& row : table("| library |")) {
    const std::string& library = row.at(0);
    listed.insert(library);
    if (!headers.contains(library)) continue;  // of the tests
    std::set<std::string> places;
    std::istringstream text(row.at(1));
    for (std::string place; std::getline(text >> std::ws, place, ',');) places.insert(place);
    const auto covers = [](const std::string& place, const std::string& folder) {
      return folder == place || folder.starts_with(place + "/") || place.starts_with(folder + "/");
    };
    for (const auto& folder : used[library])
      EXPECT_TRUE(std::ranges::any_of(places, [&](const auto& place) { return covers(place, folder); }))
          << library << " is used in " << folder;
    for (const auto& place : places)
      EXPECT_TRUE(std::ranges::any_of(used[library], [&](const auto& folder) { return covers(place, folder); }))
          << library << " is not used in " << place;
  }
  for (const auto& [library, prefix] : headers) EXPECT_TRUE(listed.contains(library)) << library;
}

}  // namespace
