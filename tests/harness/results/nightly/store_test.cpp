// The store of nights: what goes in comes out, and files that are not stores are refused.
#include "harness/results/nightly/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/special_values.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "tests/harness/results/analysis/made_up_runs.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::results {
namespace {

using fixtures::f1_run;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

RunResults night_of(const std::string& start, const std::vector<double>& f1) {
  RunResults run = f1_run(f1);
  run.provenance.start = start;
  run.settings["room"] = {{"caster", "exact"}};
  return run;
}

TEST(Store, GivesBackWhatItWasGiven) {
  const support::TemporaryFolder folder;
  RunResults run = night_of("2026-01-01T00:00:00Z", {0.1, kNaN, kInf, 1.0 / 3.0});
  run.cells[1].status = "crashed";
  run.cells[1].message = "signal 11 <'\"; DROP TABLE nights>";
  run.cells[1].rows.clear();
  run.cells[2].requested = false;
  run.cells[0].recording = "abcd";
  run.cells[0].rows[0].subject = "wall 'one'";
  run.cells[0].rows[0].unit = "m";
  run.cells[0].rows[0].count = 7;
  std::int64_t id = 0;
  {
    Store store(folder.path() / "nights.sqlite");
    id = store.add("suite", "run", run);
  }
  const Store store(folder.path() / "nights.sqlite");
  const RunResults read = store.load(id);
  EXPECT_EQ(read.settings, run.settings);
  EXPECT_EQ(read.provenance.start, run.provenance.start);
  EXPECT_EQ(read.provenance.processor, run.provenance.processor);
  ASSERT_EQ(read.cells.size(), run.cells.size());
  for (std::size_t i = 0; i < run.cells.size(); ++i) {
    const CellResults& is = read.cells[i];
    const CellResults& was = run.cells[i];
    EXPECT_EQ(is.key, was.key);
    EXPECT_EQ(is.status, was.status);
    EXPECT_EQ(is.message, was.message);
    EXPECT_EQ(is.recording, was.recording);
    EXPECT_EQ(is.requested, was.requested);
    ASSERT_EQ(is.rows.size(), was.rows.size());
    for (std::size_t r = 0; r < was.rows.size(); ++r) {
      EXPECT_EQ(is.rows[r].subject, was.rows[r].subject);
      EXPECT_EQ(is.rows[r].unit, was.rows[r].unit);
      EXPECT_EQ(is.rows[r].count, was.rows[r].count);
      EXPECT_EQ(fixtures::bits({is.rows[r].value}), fixtures::bits({was.rows[r].value}));
    }
  }
  EXPECT_THROW(store.load(id + 1), ConfigError);
}

TEST(Store, ListsTheNightsOfASuiteAndTheirTrend) {
  const support::TemporaryFolder folder;
  Store store(folder.path() / "nights.sqlite");
  for (int n = 1; n <= 5; ++n)
    store.add(n == 3 ? "other" : "suite", "run",
              night_of("2026-01-0" + std::to_string(n) + "T00:00:00Z", {0.1 * n, 0.1 * n + 0.02}),
              {"PASS", "PASS: all is well."});
  const auto nights = store.nights("suite");
  ASSERT_EQ(nights.size(), 4U);
  EXPECT_EQ(nights.front().start, "2026-01-01T00:00:00Z");
  EXPECT_EQ(nights.back().verdict, "PASS");
  EXPECT_EQ(nights.back().sentence, "PASS: all is well.");
  std::vector<double> values;
  for (const auto& point : store.trend("suite", "room", "iepf", "f1", 3)) values.push_back(point.value);
  EXPECT_THAT(values, ElementsAre(::testing::DoubleEq(0.21), ::testing::DoubleEq(0.41), ::testing::DoubleEq(0.51)));
}

TEST(Store, KeepsNightsWithOverridesOutOfTheTrend) {
  const support::TemporaryFolder folder;
  Store store(folder.path() / "nights.sqlite");
  store.add("suite", "run", night_of("2026-01-01", {0.1}));
  RunResults other = night_of("2026-01-02", {0.9});
  other.overrides = {"sensor.sigma_m=0.02", "caster=box2d"};
  store.add("suite", "run", other);
  store.add("suite", "run", night_of("2026-01-03", {0.2}));
  std::vector<double> values;
  for (const TrendPoint& point : store.trend("suite", "room", "iepf", "f1", 2)) values.push_back(point.value);
  EXPECT_THAT(values, ElementsAre(0.1, 0.2));
  ASSERT_EQ(store.nights("suite").size(), 3U);
  EXPECT_EQ(store.nights("suite")[1].overrides, "sensor.sigma_m=0.02, caster=box2d");
}

TEST(Store, OfAnEarlierVersionGetsTheOverridesOfItsCommands) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "nights.sqlite";
  {
    Store store(file);
    for (const char* command : {"scanbench nightly s.yaml", "scanbench nightly s.yaml --set a=1 --store n",
                                "scanbench nightly s.yaml --set=b=2", "scanbench nightly my --settings.yaml"}) {
      RunResults night = night_of("2026-01-01", {0.1});
      night.provenance.command = command;
      store.add("suite", "run", night);
    }
  }
  Database(file, Database::Access::write).execute("ALTER TABLE nights DROP COLUMN overrides");
  std::vector<std::string> overrides;
  for (const Night& night : Store(file).nights("suite")) overrides.push_back(night.overrides);
  EXPECT_THAT(overrides, ElementsAre("", "a=1 --store n", "b=2", ""));
}

TEST(Store, ReplacesTheKilledNightsOfTheSameFolder) {
  const support::TemporaryFolder folder;
  Store store(folder.path() / "nights.sqlite");
  for (const char* run : {"run", "other"})
    for (const char* day : {"1", "2", "3"}) store.add("suite", run, night_of("2026-01-0" + std::string(day), {0.1}));
  store.add("suite", "run", night_of("2026-01-04", {0.1}), {}, {"2026-01-02", "2026-01-03"});
  std::vector<std::string> starts;
  for (const Night& night : store.nights("suite"))
    if (night.folder == folder_in_store("run")) starts.push_back(night.start);
  EXPECT_THAT(starts, ElementsAre("2026-01-01", "2026-01-04"));
  EXPECT_EQ(store.nights("suite").size(), 5U);
}

TEST(Store, ReplacesARunThatItHasAlready) {
  const support::TemporaryFolder folder;
  Store store(folder.path() / "nights.sqlite");
  store.add("suite", "run", night_of("2026-01-01T00:00:00Z", {0.1, 0.2}));
  const auto again = store.replace("suite", "run", night_of("2026-01-01T00:00:00Z", {0.3}));
  ASSERT_EQ(store.nights("suite").size(), 1U);
  EXPECT_EQ(store.load(again).cells.size(), 1U);
  store.add("suite", "run", night_of("2026-01-01T00:00:00Z", {0.3}));  // two nights within one second
  EXPECT_EQ(store.nights("suite").size(), 2U);
}

TEST(Store, IsMadeByManyProgramsAtOnce) {
  for (int round = 0; round < 10; ++round) {
    const support::TemporaryFolder folder;
    std::atomic<int> good = 0;
    std::vector<std::thread> nights;
    for (int k = 0; k < 6; ++k)
      nights.emplace_back([&, k] {
        try {
          Store store(folder.path() / "nights.sqlite");
          store.add("suite", "run" + std::to_string(k), night_of("2026-01-01T00:00:00Z", {0.1}));
          ++good;
        } catch (const ConfigError& error) {
          ADD_FAILURE() << error.what();
        }
      });
    for (auto& night : nights) night.join();
    EXPECT_EQ(good, 6);
    EXPECT_EQ(Store(folder.path() / "nights.sqlite").nights("suite").size(), 6U);
  }
}

TEST(Store, IsReadWhileItIsWritten) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "nights.sqlite";
  Store store(file);
  store.add("suite", "run", night_of("2026-01-01T00:00:00Z", {0.1}));
  Database writer(file, Database::Access::write);
  Transaction transaction(writer);
  writer.execute("UPDATE nights SET verdict = 'FAIL'");
  EXPECT_EQ(store.nights("suite").front().verdict, "");  // of before
  transaction.commit();
  EXPECT_EQ(store.nights("suite").front().verdict, "FAIL");
}

TEST(Store, RefusesWhatIsNoStore) {
  const support::TemporaryFolder folder;
  const auto refusal = [&](const std::filesystem::path& file) {
    return support::config_refusal([&] { Store store(file); });
  };
  const auto text = folder.path() / "text";
  io::write_file_atomically(text, std::string(2000, 'x'));
  EXPECT_THAT(refusal(text), HasSubstr("text: not a store of scanbench: no SQLite file"));

  const auto other = folder.path() / "other.sqlite";
  Database(other, Database::Access::write).execute("CREATE TABLE a(b)");
  EXPECT_THAT(refusal(other), HasSubstr("not a store of scanbench: it has no table meta"));

  const auto newer = folder.path() / "newer.sqlite";
  { Store store(newer); }
  Database(newer, Database::Access::write).execute("UPDATE meta SET value = '2' WHERE key = 'schema'");
  EXPECT_THAT(refusal(newer), HasSubstr("the store has schema 2; this program reads 1"));

  const auto cut = folder.path() / "cut.sqlite";
  {
    Store store(cut);
    for (int n = 0; n < 20; ++n)
      store.add("s", "r" + std::to_string(n), night_of("2026", std::vector<double>(50, 0.5)));
    Database(cut, Database::Access::write).execute("PRAGMA wal_checkpoint(TRUNCATE)");
  }
  std::filesystem::resize_file(cut, 8192);
  EXPECT_THAT(support::config_refusal([&] { Store(cut).load(1); }), HasSubstr("damaged"));
  EXPECT_THAT(refusal(folder.path() / "absent" / "nights.sqlite"), HasSubstr("unable to open"));
}

}  // namespace
}  // namespace scanbench::results
