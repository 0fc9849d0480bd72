// Tables that are read field by field, and their numbers in one pass.
#include "harness/io/files/csv_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CsvRows, AreReadFieldByField) {
  std::string bytes =
      "\xEF\xBB\xBF"
      "name,x\r\n\"a \"\"b\"\",\nc\",1.5\r\nd,\"-2\"\n,1e3";
  CsvRows rows(bytes, "t.csv", {"x"});
  EXPECT_THAT(rows.columns(), ElementsAre("name", "x"));
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 2U);
  EXPECT_EQ(rows.text(), "a \"b\",\nc");
  EXPECT_EQ(rows.number(), 1.5);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 4U);
  EXPECT_EQ(rows.text(), "d");
  EXPECT_EQ(rows.number(), -2.0);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.text(), "");
  EXPECT_EQ(rows.number(), 1000.0);
  EXPECT_FALSE(rows.next());
}

TEST(CsvRows, RefuseWhatIsNoNumberWithItsLineAndColumn) {
  const auto refusal = [](const std::string& field) {
    return support::config_refusal([&] {
      std::string bytes = "name,x\na,1\nb," + field + "\n";
      CsvRows rows(bytes, "t.csv");
      while (rows.next()) {
        rows.text();
        rows.number();
      }
    });
  };
  for (const char* good : {"1", "-0.5", "+2", "1e-3", "\"7\"", "5.", ".5"}) EXPECT_EQ(refusal(good), "") << good;
  for (const char* bad : {"", "x", "1x", "1 ", " 1", "inf", "-inf", "nan", "1e999", "0x10", "\"\"", "1-2"})
    EXPECT_THAT(refusal(bad), HasSubstr("t.csv:3: x is ")) << bad;
  EXPECT_EQ(refusal("1,2"), "t.csv:3: found 3 fields; the first line names 2 columns");
  EXPECT_EQ(refusal("1\"2\""), "t.csv:3: a comma or the end of the line is missing");
}

}  // namespace
}  // namespace scanbench::io
