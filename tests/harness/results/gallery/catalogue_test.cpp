// Catalogues of figures: what they name must exist, and a scenario runs only what its entries need.
#include "harness/results/gallery/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.hpp"
#include "tests/support/places.hpp"

namespace scanbench::results {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::filesystem::path path() {
  return places::source_dir() / "scenarios/mine.yaml";
}

std::string entry(const std::string& more, const std::string& name = "a") {
  return "  - {name: " + name + ", of: a paper, shows: something, scenario: borges2000.yaml, " + more + "}\n";
}

Catalogue parse(const std::string& entries, const std::vector<std::string>& only = {}) {
  return parse_catalogue("schema: 1\nfigures:\n" + entries, path(), only);
}

std::string refusal(const std::string& entries, const std::vector<std::string>& only = {}) {
  try {
    parse(entries, only);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Catalogue, RunsOnlyThePipelinesSeedsAndFiguresOfItsEntries) {
  const Catalogue catalogue =
      parse(entry("figure: environment, pipelines: [iepf]") + entry("table: 1, pipelines: [lt], seeds: 3", "b"));
  ASSERT_EQ(catalogue.scenarios.size(), 1U);
  const study::Scenario& scenario = catalogue.scenarios[0];
  ASSERT_EQ(scenario.pipelines.size(), 2U);
  EXPECT_EQ(scenario.pipelines[0].name, "lt");
  EXPECT_EQ(scenario.pipelines[1].name, "iepf");
  EXPECT_THAT(scenario.seeds, ElementsAre(1U, 2U, 3U));
  ASSERT_EQ(scenario.figures.size(), 1U);
  EXPECT_EQ(scenario.figures[0].module, "environment");
  EXPECT_EQ(parse(entry("figure: environment")).scenarios[0].pipelines.size(), 3U);
}

TEST(Catalogue, PutsTheChosenSeedOfAScenarioFirst) {
  const Catalogue catalogue = parse(entry("figure: environment, seed: 7") + entry("table: 1, seeds: 3", "b"));
  EXPECT_THAT(catalogue.scenarios[0].seeds, ElementsAre(7U, 1U, 2U));
  EXPECT_THAT(refusal(entry("figure: environment, seed: 7") + entry("figure: environment, seed: 8", "b")),
              HasSubstr("an earlier figure of borges2000 has seed 7"));
  EXPECT_THAT(refusal(entry("figure: environment, seed: 21")), HasSubstr("borges2000 has no seed '21'; known: 1, 2"));
}

TEST(Catalogue, OnlySomeEntriesNeedOnlyTheirScenarios) {
  const std::string two =
      entry("figure: environment") +
      "  - {name: b, of: a paper, shows: rooms, scenario: lakaemper2010_four_rooms.yaml, figure: environment}\n";
  EXPECT_EQ(parse(two).scenarios.size(), 2U);
  const Catalogue one = parse(two, {"b"});
  ASSERT_EQ(one.scenarios.size(), 1U);
  EXPECT_EQ(one.scenarios[0].name, "lakaemper2010_four_rooms");
  EXPECT_THAT(refusal(two, {"c"}), AllOf(HasSubstr("--entry"), HasSubstr("'c'"), HasSubstr("a, b")));
}

TEST(Catalogue, DrawsOneKindOfFigureTwiceOnlyFromTheSameTraces) {
  const auto joint_space = [](const std::string& name, const std::string& pipeline) {
    return "  - {name: " + name +
           ", of: p, shows: s, scenario: lakaemper2009_spiral.yaml, figure: {name: joint_space, " +
           "params: {pipeline: " + pipeline + "}}}\n";
  };
  const std::string first = joint_space("a", "mean_shift_020");
  EXPECT_EQ(parse(first + joint_space("b", "mean_shift_020")).scenarios[0].figures.size(), 1U);
  EXPECT_THAT(refusal(first + joint_space("b", "mean_shift_030")),
              AllOf(HasSubstr("mine.yaml:4:"), HasSubstr("of the trace of mean_shift_030")));
}

TEST(Catalogue, NamesThePlaceOfWhatDoesNotExistAndTheNearestThatDoes) {
  const std::string place = path().string() + ":3:";
  EXPECT_THAT(refusal(entry("figure: enviroment")), AllOf(HasSubstr(place), HasSubstr("did you mean 'environment'?")));
  EXPECT_THAT(refusal(entry("figure: {name: environment, params: {fram: 3}}")),
              AllOf(HasSubstr(place), HasSubstr("did you mean 'frame'?")));
  EXPECT_THAT(refusal(entry("figure: environment, pipelines: [iefp]")),
              AllOf(HasSubstr(place), HasSubstr("did you mean 'iepf'?")));
  EXPECT_THAT(refusal(entry("figure: {name: merge_stages, params: {pipeline: iefp}}")),
              AllOf(HasSubstr(place), HasSubstr("iefp")));
  EXPECT_THAT(refusal("  - {name: a, of: p, shows: s, scenario: borges200.yaml, figure: environment}\n"),
              AllOf(HasSubstr(place + "42: "), HasSubstr("did you mean 'borges2000.yaml'?")));
  EXPECT_THAT(refusal(entry("table: 7")), AllOf(HasSubstr(place), HasSubstr("known: 1, 2")));
  EXPECT_THAT(refusal(entry("figure: environment, seeds: 21")), AllOf(HasSubstr(place), HasSubstr("1 .. 20")));
  EXPECT_THAT(refusal(entry("figure: environment, seeds: 1.5")), HasSubstr("a whole number"));
  EXPECT_THAT(refusal(entry("seeds: 1")), HasSubstr("either `figure` or `table`"));
  EXPECT_THAT(refusal(entry("figure: environment, table: 1")), HasSubstr("either `figure` or `table`"));
  EXPECT_THAT(refusal(entry("figure: environment, colour: red")), HasSubstr("'colour'"));
  EXPECT_THAT(refusal(entry("figure: environment") + entry("table: 1")), HasSubstr("a second figure is called a"));
  EXPECT_THAT(refusal("  - {name: ../a, of: p, shows: s, scenario: borges2000.yaml, figure: environment}\n"),
              HasSubstr("../a"));
}

TEST(Catalogue, OfTheTreeIsGoodAndNamesThingsOnce) {
  const Catalogue catalogue = load_catalogue(places::source_dir() / "scenarios/figures.yaml");
  EXPECT_GE(catalogue.entries.size(), 25U);
  std::set<std::string> papers;
  for (const auto& one : catalogue.entries) papers.insert(one.name.substr(0, one.name.find('_')));
  EXPECT_THAT(papers, ElementsAre("borges2000", "lakaemper2005", "lakaemper2009", "lakaemper2010", "siadat1997"));
  EXPECT_FALSE(catalogue.absent.empty());
}

}  // namespace
}  // namespace scanbench::results
