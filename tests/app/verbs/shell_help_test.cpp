// Completion and manual page, against --help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using Words = std::set<std::string>;

/// The words that bash offers for a command line whose last word is being typed.
Words completed(const std::string& line) {
  const Folder folder;
  folder.write("script", run({"completion"}).out);
  folder.write("a scenario.yaml", "");
  const std::string command = "source ./script; COMP_WORDS=(" + line + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " +
                              "_scanbench; printf '%s\\n' \"${COMPREPLY[@]}\"";
  const auto outcome = Child({"/bin/bash", "-u", "-c", command}, {}, folder.path()).wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::istringstream out(outcome.out);
  Words words;
  for (std::string word; std::getline(out, word);)
    if (!word.empty()) words.insert(word);
  return words;
}

/// The words of a help text that begin a line: verbs below "Subcommands:", options.
Words in_help(const std::string& text, const std::string& begin) {
  std::istringstream lines(text);
  Words words;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string first;
    if (!line.starts_with("  ") || !(fields >> first)) continue;
    std::replace(first.begin(), first.end(), ',', ' ');
    std::istringstream names(first);
    for (std::string name; names >> name;)
      if (name.starts_with(begin)) words.insert(name);
  }
  return words;
}

Words verbs() {
  const std::string help = run({"--help"}).out;
  return in_help(help.substr(help.find("Subcommands:")), "");
}

TEST(Completion, OffersEveryVerbAndEveryOptionOfTheHelp) {
  EXPECT_THAT(completed("scanbench ''"), IsSupersetOf(verbs()));
  EXPECT_THAT(verbs(), IsSupersetOf({"run", "check", "new", "build", "test", "completion", "manual"}));
  EXPECT_EQ(completed("scanbench ru"), Words{"run"});
  for (const auto& verb : verbs()) {
    if (verb == "build" || verb == "test") continue;
    EXPECT_THAT(completed("scanbench " + verb + " -"), IsSupersetOf(in_help(run({verb, "--help"}).out, "-"))) << verb;
  }
}

TEST(Completion, OffersNamesWhereNamesAreExpectedAndLeavesFilesToBash) {
  EXPECT_THAT(completed("scanbench describe ''"), IsSupersetOf({"iepf", "segments", "waypoints", "sick_lms200"}));
  EXPECT_EQ(completed("scanbench describe iep"), Words{"iepf"});
  EXPECT_THAT(completed("scanbench list ''"), IsSupersetOf({"modules", "extract", "sensor"}));
  EXPECT_THAT(completed("scanbench new ''"), IsSupersetOf({"extract", "merge"}));
  EXPECT_EQ(completed("scanbench export out/run --format c"), (Words{"carmen", "csv"}));
  EXPECT_TRUE(completed("scanbench run ''").empty());
}

TEST(ManualPage, NamesEveryVerbAndEveryOptionOfTheHelp) {
  const auto outcome = run({"manual"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::StartsWith(".TH SCANBENCH 1\n"));
  std::string plain;
  for (std::size_t i = 0; i < outcome.out.size(); ++i)
    if (outcome.out[i] != '\\' || outcome.out[i + 1] != '-') plain += outcome.out[i];
  for (const auto& verb : verbs()) {
    EXPECT_THAT(plain, HasSubstr(".SS " + verb + "\n"));
    for (const auto& option : in_help(run({verb, "--help"}).out, "--")) EXPECT_THAT(plain, HasSubstr(option)) << verb;
  }
}

TEST(BuildAndTest, AreDoneByTheScript) {
  for (const std::string verb : {"build", "test"}) {
    const auto outcome = run({verb, "--module", "iepf"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("./scanbench " + verb));
  }
}

}  // namespace
}  // namespace scanbench::app_test
