// Completion and manual page, against --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using Words = std::set<std::string>;

Words lines_of(const std::string& text) {
  std::istringstream in(text);
  Words words;
  for (std::string word; std::getline(in, word);)
    if (!word.empty()) words.insert(word);
  return words;
}

/// The words that bash offers for a command line whose last word is being typed.
Words completed(const std::string& line) {
  const Folder folder;
  folder.write("script", run({"completion", "bash"}).out);
  folder.write("a scenario.yaml", "");
  const std::string command = "source ./script; COMP_WORDS=(" + line + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " +
                              "_scanbench; printf '%s\\n' \"${COMPREPLY[@]}\"";
  const auto outcome = Child({"/bin/bash", "-u", "-c", command}, {}, folder.path()).wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return lines_of(outcome.out);
}

/// The words that zsh offers, without its own functions: each prints what it is given.
Words completed_by_zsh(const std::string& line) {
  const Folder folder;
  folder.write("script", run({"completion", "zsh"}).out);
  const std::string command =
      "compdef() { :; }; _files() { print files; }; compadd() { shift; print -l -- $@; }\n"
      "_describe() { [[ $1 == -o ]] && shift 2 || shift; print -l -- ${(P)1%%:*}; }\n"
      "source ./script; words=(" +
      line + "); CURRENT=$#words; _scanbench";
  const auto outcome = Child({"/bin/zsh", "-f", "-c", command}, {}, folder.path()).wait();
  EXPECT_EQ(outcome.err, "");
  return lines_of(outcome.out);
}

/// The words that fish offers, without what it says of each.
Words completed_by_fish(const std::string& line) {
  const Folder folder;
  folder.write("script", run({"completion", "fish"}).out);
  const auto outcome = Child({"/usr/bin/fish", "--no-config", "-c", "source ./script; complete -C " + line},
                             {{"HOME", folder.path().string()}}, folder.path())
                           .wait();
  EXPECT_EQ(outcome.err, "");
  Words words;
  for (const std::string& offered : lines_of(outcome.out)) words.insert(offered.substr(0, offered.find('\t')));
  return words;
}

/// The words of a help text that begin a line and themselves with `begin`.
Words in_help(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  Words words;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string first;
    if (!line.starts_with("  ") || line.starts_with("   ") || !(fields >> first)) continue;
    std::replace(first.begin(), first.end(), ',', ' ');
    std::istringstream names(first);
    for (std::string name; names >> name;)
      if (name.starts_with(begin)) words.insert(name);
  }
  return words;
}

/// The verbs below a verb; of the whole program for "". All sections but that of the options name verbs.
Words verbs(const std::string& owner = "") {
  const std::string help = run(owner.empty() ? Args{"--help"} : Args{owner, "--help"}).out;
  const auto options = help.find("Options:");
  Words words = in_help(help.substr(help.find("\n\n", options)), "");
  std::erase_if(words, [](const std::string& word) { return word.starts_with('-'); });
  return words;
}

/// Every verb as it is typed, word by word.
std::vector<Args> paths() {
  std::vector<Args> all;
  for (const auto& verb : verbs()) {
    all.push_back({verb});
    for (const std::string owner : {"sweep", "night", "module"})
      if (verb == owner)
        for (const auto& below : verbs(owner)) all.push_back({owner, below});
  }
  return all;
}

std::string typed(const Args& path) {
  return path.size() == 1 ? path[0] : path[0] + " " + path[1];
}

Args with(Args path, const std::string& word) {
  path.push_back(word);
  return path;
}

bool is_done_by_the_script(const std::string& verb) {
  return verb == "build" || verb == "test" || verb == "peers";
}

TEST(Help, HasFiveDrawersAndAtMostSevenVerbsInEach) {
  const std::string help = run({"--help"}).out;
  const std::vector<std::string> drawers{"Run scenarios:", "Look at results:", "Every night, on many machines:",
                                         "Modules, and whatever else has a name:", "This program:"};
  std::size_t at = help.find("Options:");
  for (const auto& drawer : drawers) {
    const auto next = help.find("\n" + drawer + "\n");
    ASSERT_NE(next, std::string::npos) << drawer;
    EXPECT_GT(next, at);
    at = next;
    const auto body = help.substr(next, help.find("\n\n", next + 1) - next);
    EXPECT_LE(in_help(body, "").size(), 7U) << body;
  }
  EXPECT_EQ(help.find("Subcommands"), std::string::npos);
  EXPECT_EQ(verbs("sweep"), (Words{"plan", "run", "status", "merge", "submit", "unpack"}));
  EXPECT_EQ(verbs("night"), (Words{"run", "accept", "store"}));
  EXPECT_EQ(verbs("module"), (Words{"new", "conform"}));
  EXPECT_EQ(run({"run", "--help"}).out.find("Excludes"), std::string::npos);
}

TEST(Help, OfFormerVerbsIsTheirNewName) {
  const std::map<std::string, std::string> now{
      {"plan", "sweep plan"},     {"status", "sweep status"},   {"merge", "sweep merge"},   {"submit", "sweep submit"},
      {"unpack", "sweep unpack"}, {"nightly", "night run"},     {"accept", "night accept"}, {"store", "night store"},
      {"new", "module new"},      {"conform", "module conform"}};
  for (const auto& [former, verb] : now) {
    for (const Args& args : {Args{former}, Args{former, "--help"}, Args{former, "a", "b", "--seed", "1"}}) {
      const auto outcome = run(args);
      EXPECT_EQ(outcome.code, 2);
      EXPECT_EQ(outcome.err, "scanbench: `" + former + "` is now `" + verb + "`\n");
    }
    EXPECT_EQ(verbs().count(former), 0U) << former;
  }
}

TEST(Help, OptionsOfOneNameTakeAValueInEveryVerbOrInNone) {
  std::map<std::string, std::set<std::string>> kinds;  // option: "TEXT", "" of a flag; and its bounds or words
  for (const Args& path : paths()) {
    std::istringstream help(run(with(path, "--help")).out);
    for (std::string line; std::getline(help, line);) {
      std::istringstream fields(line);
      std::string names, type;
      if (!line.starts_with("  -") || !(fields >> names)) continue;
      // "  -j,--jobs INT:1 .. 1024 [1]": the column of the descriptions begins after two blanks or in the next line
      const auto begin = line.find(names) + names.size();
      const std::string rest = line.substr(begin, line.find("  ", begin) - begin);
      std::istringstream(rest) >> type;
      const std::string name = names.substr(names.rfind("--") == std::string::npos ? 0 : names.rfind("--"));
      kinds[name].insert(type.empty() ? "a flag" : "a value");
    }
  }
  EXPECT_GT(kinds.size(), 40U);
  for (const auto& [name, kind] : kinds) EXPECT_EQ(kind.size(), 1U) << name;
  EXPECT_EQ(kinds.at("--json"), (std::set<std::string>{"a flag"}));
  for (const char* former : {"--markdown", "--pipelines", "--plan", "--csv", "--junit"})
    EXPECT_FALSE(kinds.contains(former)) << former;
}

TEST(Completion, OffersEveryVerbAndEveryOptionOfTheHelp) {
  EXPECT_THAT(completed("scanbench ''"), IsSupersetOf(verbs()));
  EXPECT_THAT(verbs(), IsSupersetOf({"run", "check", "sweep", "build", "test", "completion", "manual"}));
  EXPECT_EQ(completed("scanbench ru"), Words{"run"});
  EXPECT_EQ(completed("scanbench sweep ''"), verbs("sweep"));
  for (const auto& path : paths()) {
    if (is_done_by_the_script(path[0])) continue;
    EXPECT_THAT(completed("scanbench " + typed(path) + " -"), IsSupersetOf(in_help(run(with(path, "--help")).out, "-")))
        << typed(path);
  }
}

TEST(Completion, OffersNamesWhereNamesAreExpectedAndLeavesFilesToBash) {
  EXPECT_THAT(completed("scanbench describe ''"), IsSupersetOf({"iepf", "segments", "waypoints", "sick_lms200"}));
  EXPECT_EQ(completed("scanbench describe iep"), Words{"iepf"});
  EXPECT_THAT(completed("scanbench list ''"), IsSupersetOf({"modules", "extract", "sensor"}));
  EXPECT_THAT(completed("scanbench module new ''"), IsSupersetOf({"extract", "merge"}));
  EXPECT_EQ(completed("scanbench sweep submit ''"), Words{"slurm"});
  EXPECT_EQ(completed("scanbench export out/run --format c"), (Words{"carmen", "csv"}));
  EXPECT_TRUE(completed("scanbench run ''").empty());
}

/// What a shell offers for a line, against what is expected; `words` of the help may be more than the shell shows.
void check_other_shell(const std::function<Words(const std::string&)>& offered) {
  EXPECT_THAT(offered("scanbench ''"), IsSupersetOf(verbs()));
  EXPECT_THAT(offered("scanbench sweep ''"), IsSupersetOf(verbs("sweep")));
  EXPECT_THAT(offered("scanbench describe iep"), IsSupersetOf({"iepf"}));
  EXPECT_EQ(offered("scanbench film --style ''"), (Words{"paper", "dark"}));
  for (const Args& path : {Args{"run"}, Args{"sweep", "plan"}, Args{"night", "run"}, Args{"figures"}})
    EXPECT_THAT(offered("scanbench " + typed(path) + " --"), IsSupersetOf(in_help(run(with(path, "--help")).out, "--")))
        << typed(path);
}

TEST(Completion, OfZshOffersTheSame) {
  if (!fs::exists("/bin/zsh")) GTEST_SKIP() << "there is no zsh";
  check_other_shell(completed_by_zsh);
  EXPECT_EQ(completed_by_zsh("scanbench run ''"), Words{"files"});
  EXPECT_EQ(completed_by_zsh("scanbench run --out ''"), Words{"files"});
}

TEST(Completion, OfFishOffersTheSame) {
  if (!fs::exists("/usr/bin/fish")) GTEST_SKIP() << "there is no fish";
  check_other_shell([](const std::string& line) {
    const auto end = line.find("''");
    return completed_by_fish("'" + line.substr(0, end) + "'");
  });
}

TEST(Completion, RefusesOtherShells) {
  const auto outcome = run({"completion", "csh"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'csh' is not a shell; did you mean 'zsh'?; allowed: bash, zsh, fish"));
}

TEST(ManualPage, NamesEveryVerbAndEveryOptionOfTheHelp) {
  const auto outcome = run({"manual"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::StartsWith(".TH SCANBENCH 1\n"));
  std::string plain;
  for (std::size_t i = 0; i < outcome.out.size(); ++i)
    if (outcome.out[i] != '\\' || outcome.out[i + 1] != '-') plain += outcome.out[i];
  for (const auto& path : paths()) {
    EXPECT_THAT(plain, HasSubstr(".SS " + typed(path) + "\n"));
    for (const auto& option : in_help(run(with(path, "--help")).out, "--"))
      EXPECT_THAT(plain, HasSubstr(option)) << typed(path);
  }
}

TEST(BuildAndTest, AreDoneByTheScript) {
  for (const std::string verb : {"build", "test", "peers"}) {
    const auto outcome = run({verb, "--module", "iepf"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("./scanbench " + verb));
  }
}

}  // namespace
}  // namespace scanbench::app_test
