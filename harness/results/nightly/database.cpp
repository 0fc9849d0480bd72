// Wraps the C interface of SQLite.
#include "harness/results/nightly/database.hpp"

#include <sqlite3.h>

#include <cmath>

#include "core/error.hpp"
#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

constexpr int kWaitMilliseconds = 10000;  // for another program that writes

}  // namespace

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close(handle);
}

Database::Database(const std::filesystem::path& file, Access access) : file_(file) {
  const int flags = access == Access::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) refuse_last();
  sqlite3_busy_timeout(handle, kWaitMilliseconds);
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) refuse_last();
}

// SQLite does not wait for locks in this statement.
void Database::use_write_ahead_log() {
  constexpr int kPauseMilliseconds = 20;
  for (int waited = 0;; waited += kPauseMilliseconds) {
    const int code = sqlite3_exec(handle_.get(), "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
    if (code == SQLITE_OK) return;
    if (code != SQLITE_BUSY || waited >= kWaitMilliseconds) refuse_last();
    sqlite3_sleep(kPauseMilliseconds);
  }
}

std::int64_t Database::last_id() const {
  return sqlite3_last_insert_rowid(handle_.get());
}

void Database::refuse(const std::string& reason) const {
  throw ConfigError(file_.string() + ": " + reason);
}

void Database::refuse_last() const {
  const int code = handle_ ? sqlite3_errcode(handle_.get()) : SQLITE_NOMEM;
  if (code == SQLITE_NOTADB) refuse("not a store of scanbench: no SQLite file");
  if (code == SQLITE_CORRUPT) refuse("the store is damaged; rebuild it from the run folders (scanbench night store)");
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) refuse("another program is writing to the store; try again later");
  refuse(handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory");
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v2(database.handle_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  statement_.reset(statement);
  check(code);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.refuse_last();
}

Statement& Statement::bind(int parameter, std::string_view text) {
  check(
      sqlite3_bind_text(statement_.get(), parameter + 1, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), parameter + 1, value));
  return *this;
}

Statement& Statement::bind(int parameter, double value) {
  check(std::isnan(value) ? sqlite3_bind_null(statement_.get(), parameter + 1)
                          : sqlite3_bind_double(statement_.get(), parameter + 1, value));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.refuse_last();
  return false;
}

void Statement::run() {
  step();
  reset();
}

void Statement::reset() {
  check(sqlite3_reset(statement_.get()));
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return bytes == nullptr
             ? std::string()
             : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::number(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL ? kNaN
                                                                      : sqlite3_column_double(statement_.get(), column);
}

Transaction::Transaction(Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.execute("ROLLBACK");
  } catch (const ConfigError&) {  // closing the file rolls back too
  }
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace scanbench::results
