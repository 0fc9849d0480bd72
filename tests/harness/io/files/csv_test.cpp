// CSV files: quotes, exact numbers, and messages with file and line.
#include "harness/io/files/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace scanbench::io {
namespace {

TEST(Csv, QuotesOnlyWhereRfc4180DemandsIt) {
  CsvWriter csv({"a", "b"});
  csv.text("plain text").text("x, \"y\"\nz").end_row();
  csv.number(0.1).number(std::numeric_limits<double>::quiet_NaN()).end_row();
  csv.number(-std::numeric_limits<double>::infinity()).seed(18446744073709551615ull).end_row();
  EXPECT_EQ(csv.str(), "a,b\nplain text,\"x, \"\"y\"\"\nz\"\n0.1,\n-inf,18446744073709551615\n");
}

TEST(Csv, GivesBackTextsAndEveryBitOfNumbers) {
  const double values[] = {0.1 + 0.2, -0.0, 5e-324, 1.7976931348623157e308, std::nextafter(1.0, 2.0)};
  CsvWriter csv({"text", "number"});
  for (const double v : values) csv.text("l1\r\nl2,\"").number(v).end_row();
  const CsvTable table(csv.str(), "f.csv", {"number", "text"});
  ASSERT_EQ(table.rows(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(table.text(i, "text"), "l1\r\nl2,\"");
    EXPECT_EQ(table.number(i, "number"), values[i]);
    EXPECT_EQ(std::signbit(table.number(i, "number")), std::signbit(values[i]));
  }
}

TEST(Csv, ReadsLineEndsOfEitherKindAndALastLineWithout) {
  const CsvTable table("a,b\r\n1,\r\n,2", "f.csv");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.integer(0, "a"), 1);
  EXPECT_TRUE(std::isnan(table.number(0, "b")));
  EXPECT_EQ(table.optional_number(1, "a"), std::nullopt);
  EXPECT_EQ(table.index(1, "b"), 2);
}

TEST(Csv, NamesFileAndLineOfWhatIsWrong) {
  const auto message = [](const std::string& text, bool use) -> std::string {
    try {
      const CsvTable table(text, "d/f.csv", {"a"});
      if (use) table.index(1, "a");
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  };
  using ::testing::StartsWith;
  EXPECT_THAT(message("b\n1\n", false), StartsWith("d/f.csv:1: the column 'a'"));
  EXPECT_THAT(message("", false), StartsWith("d/f.csv:1: the column 'a'"));
  EXPECT_THAT(message("a,b\n1,2\n\"x\ny\",2,3\n", false), StartsWith("d/f.csv:3: found 3 fields"));
  EXPECT_THAT(message("a\n\"x\n", false), StartsWith("d/f.csv:2: a quote"));
  EXPECT_THAT(message("a\n\"x\"y\n", false), StartsWith("d/f.csv:2: "));
  EXPECT_THAT(message("a\n1\n2.5\n", true), StartsWith("d/f.csv:3: a is '2.5'"));
  EXPECT_THAT(message("a\n1\n3000000000\n", true), StartsWith("d/f.csv:3: a is 3000000000"));
  EXPECT_EQ(message("a\n1\n2\n", true), "accepted");
}

TEST(Csv, QuotesOnlyTheBeginningOfALongValueThatIsNoNumber) {
  const CsvTable table("a\n" + std::string(300000, 'x') + "\n", "f.csv");
  for (const bool whole : {false, true}) try {
      whole ? static_cast<double>(table.integer(0, "a")) : table.number(0, "a");
      ADD_FAILURE() << "read";
    } catch (const ConfigError& e) {
      EXPECT_LT(std::string(e.what()).size(), 200u);
      EXPECT_THAT(e.what(), ::testing::StartsWith("f.csv:2: a is 'xxx"));
    }
}

TEST(Csv, KeepsItsFieldsWhenItIsMoved) {
  CsvTable first("a,b\n\"x\"\"y\",short\n", "f.csv");  // texts that a string keeps within itself
  const CsvTable moved = std::move(first);
  EXPECT_EQ(moved.text(0, "a"), "x\"y");
  EXPECT_EQ(moved.field(0, "b"), "short");
}

}  // namespace
}  // namespace scanbench::io
