// Writes nights into the store and reads them back.
#include "harness/results/nightly/store.hpp"

#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchemaVersion = "1";

constexpr const char* kTables = R"sql(
CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE nights(night INTEGER PRIMARY KEY, suite TEXT NOT NULL, start TEXT NOT NULL, commit_hash TEXT NOT NULL,
  compiler TEXT NOT NULL, libraries TEXT NOT NULL, processor TEXT NOT NULL, command TEXT NOT NULL, folder TEXT NOT NULL,
  verdict TEXT NOT NULL DEFAULT '', sentence TEXT NOT NULL DEFAULT '', overrides TEXT NOT NULL DEFAULT '');
CREATE TABLE settings(night INTEGER NOT NULL REFERENCES nights ON DELETE CASCADE, scenario TEXT NOT NULL,
  path TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY(night, scenario, path)) WITHOUT ROWID;
CREATE TABLE cells(cell INTEGER PRIMARY KEY, night INTEGER NOT NULL REFERENCES nights ON DELETE CASCADE,
  scenario TEXT NOT NULL, pipeline TEXT NOT NULL, seed INTEGER NOT NULL, status TEXT NOT NULL, message TEXT NOT NULL,
  recording TEXT NOT NULL, requested INTEGER NOT NULL);
CREATE UNIQUE INDEX cell_of_night ON cells(night, scenario, pipeline, seed);
CREATE TABLE metrics(metric INTEGER PRIMARY KEY, name TEXT NOT NULL, unit TEXT NOT NULL, UNIQUE(name, unit));
CREATE TABLE metric_rows(cell INTEGER NOT NULL REFERENCES cells ON DELETE CASCADE, position INTEGER NOT NULL,
  metric INTEGER NOT NULL REFERENCES metrics, subject TEXT NOT NULL, value REAL, count INTEGER NOT NULL,
  PRIMARY KEY(cell, position)) WITHOUT ROWID;
INSERT INTO meta VALUES('program', 'scanbench'), ('schema', '1');
)sql";

/// The number of every metric of the table `metrics`.
class MetricNumbers {
 public:
  explicit MetricNumbers(Database& database)
      : database_(database), insert_(database, "INSERT INTO metrics(name, unit) VALUES(?, ?)") {
    Statement all(database, "SELECT metric, name, unit FROM metrics");
    while (all.step()) numbers_[{all.text(1), all.text(2)}] = all.integer(0);
  }

  std::int64_t of(const metrics::MetricRow& row) {
    const auto [place, is_new] = numbers_.try_emplace({row.metric, row.unit});
    if (is_new) {
      insert_.bind(0, row.metric).bind(1, row.unit).run();
      place->second = database_.last_id();
    }
    return place->second;
  }

 private:
  Database& database_;
  Statement insert_;
  std::map<std::pair<std::string, std::string>, std::int64_t> numbers_;
};

void add_cells(Database& database, std::int64_t night, const std::vector<CellResults>& cells) {
  MetricNumbers metrics(database);
  Statement cell_row(database,
                     "INSERT INTO cells(night, scenario, pipeline, seed, status, message, recording, requested) "
                     "VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  Statement value_row(
      database, "INSERT INTO metric_rows(cell, position, metric, subject, value, count) VALUES(?, ?, ?, ?, ?, ?)");
  for (const auto& cell : cells) {
    cell_row.bind(0, night).bind(1, cell.key.scenario).bind(2, cell.key.pipeline);
    cell_row.bind(3, static_cast<std::int64_t>(cell.key.seed)).bind(4, cell.status).bind(5, cell.message);
    cell_row.bind(6, cell.recording).bind(7, std::int64_t{cell.requested ? 1 : 0}).run();
    const std::int64_t id = database.last_id();
    std::int64_t position = 0;
    for (const auto& row : cell.rows) {
      value_row.bind(0, id).bind(1, position++).bind(2, metrics.of(row)).bind(3, row.subject);
      value_row.bind(4, row.value).bind(5, row.count).run();
    }
  }
}

}  // namespace

std::string folder_in_store(const fs::path& folder) {
  return fs::absolute(folder).lexically_normal().string();
}

Store::Store(const fs::path& file) : database_(file, Database::Access::write) {
  database_.execute("PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL");
  if (is_empty()) create();
  check_schema();
  add_overrides();
}

/// A store of an earlier version has no column for overrides; the nights that had some say so in their command.
void Store::add_overrides() {
  const auto is_missing = [&] {
    Statement column(database_, "SELECT count(*) FROM pragma_table_info('nights') WHERE name = 'overrides'");
    column.step();
    return column.integer(0) == 0;
  };
  if (!is_missing()) return;
  Transaction transaction(database_);
  if (is_missing())  // another night may have added it since
    database_.execute(
        "ALTER TABLE nights ADD COLUMN overrides TEXT NOT NULL DEFAULT ''; "
        "UPDATE nights SET overrides = substr(command, instr(command, ' --set') + 7) WHERE command LIKE '% --set %' OR "
        "command LIKE '% --set=%'");
  transaction.commit();
}

bool Store::is_empty() const {
  Statement tables(database_, "SELECT count(*) FROM sqlite_master");
  tables.step();
  return tables.integer(0) == 0;
}

void Store::create() {
  database_.use_write_ahead_log();
  Transaction transaction(database_);
  if (is_empty()) database_.execute(kTables);  // another night may have made them since
  transaction.commit();
}

void Store::check_schema() const {
  Statement meta(database_, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'meta'");
  meta.step();
  if (meta.integer(0) == 0) database_.refuse("not a store of scanbench: it has no table meta");
  std::map<std::string, std::string> values;
  Statement rows(database_, "SELECT key, value FROM meta");
  while (rows.step()) values[rows.text(0)] = rows.text(1);
  if (values["program"] != "scanbench") database_.refuse("another program wrote this database");
  if (values["schema"] != kSchemaVersion)
    database_.refuse("the store has schema " + values["schema"] + "; this program reads " + kSchemaVersion +
                     " (a store can be made again from the run folders: scanbench night store)");
}

std::int64_t Store::add(const std::string& suite, const fs::path& folder, const RunResults& results,
                        const StoredVerdict& verdict, const std::vector<std::string>& unfinished) {
  Transaction transaction(database_);
  for (const auto& start : unfinished) remove(folder_in_store(folder), start);
  const std::int64_t night = insert(suite, folder_in_store(folder), results, verdict);
  transaction.commit();
  return night;
}

std::int64_t Store::replace(const std::string& suite, const fs::path& folder, const RunResults& results) {
  Transaction transaction(database_);
  remove(folder_in_store(folder), results.provenance.start);
  const std::int64_t night = insert(suite, folder_in_store(folder), results, {});
  transaction.commit();
  return night;
}

void Store::remove(const std::string& place, const std::string& start) {
  Statement nights(database_, "DELETE FROM nights WHERE start = ? AND folder = ?");
  nights.bind(0, start).bind(1, place).run();
}

std::int64_t Store::insert(const std::string& suite, const std::string& place, const RunResults& results,
                           const StoredVerdict& verdict) {
  Statement head(database_,
                 "INSERT INTO nights(suite, start, commit_hash, compiler, libraries, processor, command, folder, "
                 "verdict, sentence, overrides) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  const runs::Provenance& by = results.provenance;
  head.bind(0, suite).bind(1, by.start).bind(2, by.commit).bind(3, by.compiler).bind(4, by.libraries);
  head.bind(5, by.processor).bind(6, by.command).bind(7, place);
  head.bind(8, verdict.word).bind(9, verdict.sentence).bind(10, join(results.overrides)).run();
  const std::int64_t night = database_.last_id();
  Statement setting(database_, "INSERT INTO settings VALUES(?, ?, ?, ?)");
  for (const auto& [scenario, settings] : results.settings)
    for (const auto& [path, value] : settings)
      setting.bind(0, night).bind(1, scenario).bind(2, path).bind(3, value).run();
  add_cells(database_, night, results.cells);
  return night;
}

std::vector<Night> Store::nights(const std::string& suite) const {
  Statement rows(
      database_,
      "SELECT night, suite, start, commit_hash, folder, verdict, sentence, overrides FROM nights WHERE suite = ? "
      "ORDER BY start, night");
  rows.bind(0, suite);
  std::vector<Night> nights;
  while (rows.step())
    nights.push_back({rows.integer(0), rows.text(1), rows.text(2), rows.text(3), rows.text(4), rows.text(5),
                      rows.text(6), rows.text(7)});
  return nights;
}

RunResults Store::load(std::int64_t night) const {
  RunResults results;
  Statement head(database_,
                 "SELECT start, commit_hash, compiler, libraries, processor, command FROM nights WHERE night = ?");
  head.bind(0, night);
  if (!head.step()) database_.refuse("it has no night " + std::to_string(night));
  results.provenance = {head.text(1), head.text(2), head.text(3), head.text(4), head.text(0), head.text(5)};
  results.name = "night of " + head.text(0);
  Statement settings(database_, "SELECT scenario, path, value FROM settings WHERE night = ?");
  settings.bind(0, night);
  while (settings.step()) results.settings[settings.text(0)][settings.text(1)] = settings.text(2);
  std::map<std::int64_t, std::size_t> places;
  Statement cells(database_,
                  "SELECT cell, scenario, pipeline, seed, status, message, recording, requested FROM cells WHERE night "
                  "= ? ORDER BY cell");
  cells.bind(0, night);
  while (cells.step()) {
    CellResults cell;
    cell.key = {cells.text(1), cells.text(2), static_cast<std::uint64_t>(cells.integer(3))};
    cell.status = cells.text(4);
    cell.message = cells.text(5);
    cell.recording = cells.text(6);
    cell.requested = cells.integer(7) != 0;
    places[cells.integer(0)] = results.cells.size();
    results.cells.push_back(std::move(cell));
  }
  Statement rows(database_,
                 "SELECT r.cell, m.name, r.subject, r.value, m.unit, r.count FROM cells c JOIN metric_rows r ON r.cell "
                 "= c.cell JOIN metrics m ON m.metric = r.metric WHERE c.night = ? ORDER BY r.cell, r.position");
  rows.bind(0, night);
  while (rows.step()) {
    metrics::MetricRow row;
    row.metric = rows.text(1);
    row.subject = rows.text(2);
    row.value = rows.number(3);
    row.unit = rows.text(4);
    row.count = rows.integer(5);
    results.cells[places.at(rows.integer(0))].rows.push_back(std::move(row));
  }
  return results;
}

std::vector<TrendPoint> Store::trend(const std::string& suite, const std::string& scenario, const std::string& pipeline,
                                     const std::string& metric, std::size_t count) const {
  Statement rows(
      database_,
      "SELECT n.night, n.start, n.commit_hash, avg(r.value) FROM "
      "(SELECT * FROM nights WHERE suite = ?1 AND overrides = '' ORDER BY start DESC, night DESC LIMIT ?5) n "
      "JOIN cells c ON c.night = n.night AND c.scenario = ?2 AND c.pipeline = ?3 "
      "JOIN metric_rows r ON r.cell = c.cell JOIN metrics m ON m.metric = r.metric AND m.name = ?4 "
      "WHERE r.value IS NOT NULL AND (r.subject = 'all' OR NOT EXISTS (SELECT 1 FROM metric_rows a WHERE "
      "a.cell = r.cell AND a.metric = r.metric AND a.subject = 'all')) "
      "GROUP BY n.night ORDER BY n.start, n.night");
  rows.bind(0, suite).bind(1, scenario).bind(2, pipeline).bind(3, metric).bind(4, static_cast<std::int64_t>(count));
  std::vector<TrendPoint> points;
  while (rows.step()) points.push_back({rows.integer(0), rows.text(1), rows.text(2), rows.number(3)});
  return points;
}

}  // namespace scanbench::results
