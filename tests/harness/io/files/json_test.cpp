// JSON as text: RFC 8259 says which texts are JSON.
#include "harness/io/files/json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace scanbench::io {
namespace {

const nlohmann::ordered_json kValue{{"b", {1, 2.5}}, {"a", "line"}, {"none", nullptr}};

TEST(JsonText, KeepsTheOrderOfKeysAndIndents) {
  EXPECT_EQ(json_text(kValue), "{\n  \"b\": [\n    1,\n    2.5\n  ],\n  \"a\": \"line\",\n  \"none\": null\n}");
  EXPECT_EQ(json_text({{"a", 1}}, 1), "{\n \"a\": 1\n}");
  EXPECT_EQ(json_line(kValue), R"({"b":[1,2.5],"a":"line","none":null})");
  EXPECT_EQ(json_line(nlohmann::json{{"b", 1}, {"a", 2}}), R"({"a":2,"b":1})");  // a map, in the order of its keys
}

TEST(JsonText, ReplacesWhatIsNoUtf8OrForForeignModulesRefusesIt) {
  const nlohmann::ordered_json broken = std::string("a\xff");
  EXPECT_EQ(json_line(broken), "\"a\xEF\xBF\xBD\"");  // U+FFFD
  EXPECT_EQ(json_text(broken), "\"a\xEF\xBF\xBD\"");
  EXPECT_THROW(json_line(nlohmann::json(std::string("\xff"))), nlohmann::json::exception);
}

TEST(JsonText, OfAsciiEscapesOtherCharacters) {
  EXPECT_EQ(json_line(nlohmann::ordered_json("ü€")), "\"ü€\"");
  EXPECT_EQ(json_ascii_line("ü€"), R"("\u00fc\u20ac")");
  EXPECT_EQ(json_ascii_line("\xF0\x9F\x98\x80"), R"("\ud83d\ude00")");  // U+1F600, outside the basic plane
}

TEST(ParsedJson, IsTheValueOfTheTextOrDiscarded) {
  EXPECT_EQ(parsed_json(R"( {"a": [1, -2.5e1, "x", true, null]} )"),
            (nlohmann::json{{"a", {1, -25.0, "x", true, nullptr}}}));
  for (const char* text : {"", "{", "[1,]", "{'a': 1}", "nan", "1 2", "\"\xff\""})
    EXPECT_TRUE(parsed_json(text).is_discarded()) << text;
}

}  // namespace
}  // namespace scanbench::io
