// Commands in README and docs name verbs and options that the program has. Tests of their pages run many of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

/// The pages of the project but the change log, whose old entries keep the names of their time.
std::vector<fs::path> pages() {
  std::vector<fs::path> found{"README.md", "CONTRIBUTING.md", "peers/README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(places::source_dir() / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path().lexically_relative(places::source_dir()));
  return found;
}

/// The words after `scanbench` of each command in a code span or at the beginning of a line of a block, up to what is
/// not part of it.
std::vector<Args> commands_in(const std::string& text) {
  std::vector<Args> found;
  const std::regex command(R"((?:`|\n|&& |run: |ExecStart=\S*/)(?:\./)?scanbench ([a-z][^`#|;&]*))");
  for (std::sregex_iterator it(text.begin(), text.end(), command), end; it != end; ++it) {
    const bool is_span = it->str()[0] == '`';  // a span may go on in the next line
    const std::string words = it->str(1);
    std::istringstream in(is_span ? words : words.substr(0, words.find('\n')));
    Args& args = found.emplace_back();
    for (std::string word; in >> word;) args.push_back(word);
  }
  return found;
}

/// The verb and, of a verb with verbs, the one below it.
Args path_of(const Args& args) {
  const bool has_verbs = args[0] == "sweep" || args[0] == "night" || args[0] == "module";
  return {args.begin(), args.begin() + (has_verbs && args.size() > 1 ? 2 : 1)};
}

const Outcome& help_of(const Args& path) {
  static std::map<Args, Outcome> known;
  if (!known.contains(path)) {
    Args args = path;
    args.emplace_back("--help");
    known[path] = run(args);
  }
  return known.at(path);
}

TEST(CommandsOfPages, NameVerbsAndOptionsThatTheProgramHas) {
  std::size_t count = 0;
  for (const auto& page : pages()) {
    for (const Args& args : commands_in(read(places::source_dir() / page))) {
      ++count;
      const Args path = path_of(args);
      const Outcome& help = help_of(path);
      EXPECT_EQ(help.code, 0) << page << ": " << args[0] << "\n" << help.err;
      if (args[0] == "test" || args[0] == "build" || args[0] == "peers") continue;  // of the script
      for (const std::string& word : args) {
        if (!word.starts_with("--")) continue;
        EXPECT_THAT(help.out, testing::ContainsRegex(word.substr(0, word.find('=')) + "[ \n]"))
            << page << ": " << args[0];
      }
    }
  }
  EXPECT_GT(count, 100U);
}

}  // namespace
}  // namespace scanbench::app_test
