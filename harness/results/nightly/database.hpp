// SQLite with errors as exceptions and values by type: the little of it that the store uses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace scanbench::results {

class Database;

/// A prepared statement. Parameters and columns count from 0.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);

  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);  ///< NaN is stored as NULL, infinities as themselves

  /// The next row of the result; false at its end.
  bool step();
  /// Runs a statement that has no rows, and makes it ready for other parameters.
  void run();
  void reset();

  std::string text(int column) const;
  std::int64_t integer(int column) const;
  double number(int column) const;  ///< NaN for NULL

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int code) const;

  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An open database file. Every failure throws a ConfigError with the file's name and SQLite's reason.
class Database {
 public:
  enum class Access { read, write };
  Database(const std::filesystem::path& file, Access access);

  void execute(const std::string& sql);
  /// Lets others read while one writes. Waits while another program opens the file, as long as statements do.
  void use_write_ahead_log();
  std::int64_t last_id() const;
  [[noreturn]] void refuse(const std::string& reason) const;
  [[noreturn]] void refuse_last() const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// All statements while one exists take effect together at commit(), or not at all.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace scanbench::results
