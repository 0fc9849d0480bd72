// The YAML gate, the typed reader, overrides, and the canonical writer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "harness/io/yaml/gate.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/io/yaml/sets.hpp"
#include "harness/io/yaml/writer.hpp"

namespace scanbench::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// "line:column: message" of the refusal, "" if there is none.
template <class Work>
std::string refusal(Work&& work) {
  try {
    work();
  } catch (const PlacedError& error) {
    return std::to_string(error.mark().line) + ":" + std::to_string(error.mark().column) + ": " + error.what();
  }
  return "";
}

std::string parse_refusal(const std::string& text) {
  return refusal([&] { parse_yaml(text); });
}

ParamSpec spec(ParamType type, Bounds bounds = {}) {
  ParamSpec s;
  s.name = "p";
  s.type = type;
  s.bounds = bounds;
  return s;
}

std::string read_refusal(const std::string& value, const ParamSpec& s) {
  const YamlNode root = parse_yaml("p: " + value);
  return refusal([&] { read_param(*root.find("p"), s); });
}

ParamValue read(const std::string& value, const ParamSpec& s) {
  const YamlNode root = parse_yaml("p: " + value);
  return read_param(*root.find("p"), s);
}

TEST(YamlGate, KeepsOrderPlacesAndQuotes) {
  const YamlNode root = parse_yaml("b: 1\na: [x, \"2\", ~]\n");
  ASSERT_EQ(root.entries.size(), 2U);
  EXPECT_EQ(root.entries[0].key, "b");
  const YamlNode& list = *root.find("a");
  EXPECT_EQ(list.mark.line, 2);
  EXPECT_EQ(list.items[1].mark.column, 8);
  EXPECT_TRUE(list.items[1].quoted);
  EXPECT_FALSE(list.items[0].quoted);
  EXPECT_EQ(list.items[2].kind, YamlKind::null);
}

TEST(YamlGate, RefusesWhatYamlCppWouldLetThrough) {
  EXPECT_THAT(parse_refusal("a: 1\nb: 2\na: 3\n"),
              HasSubstr("3:1: the key 'a' occurs a second time; the first is in line 1"));
  EXPECT_THAT(parse_refusal("a: &x 1\nb: *x\n"), HasSubstr("an anchor"));
  EXPECT_THAT(parse_refusal("a: {b: &x 1}\n"), HasSubstr("an anchor"));
  EXPECT_THAT(parse_refusal("<<: {a: 1}\n"), HasSubstr("1:1: a merge key"));
  EXPECT_THAT(parse_refusal("a: !!str 1\n"), HasSubstr("a tag"));
  EXPECT_THAT(parse_refusal("a: !mine {}\n"), HasSubstr("a tag"));
  EXPECT_THAT(parse_refusal("[a]: 1\n"), HasSubstr("a key is a list or a map"));
  EXPECT_THAT(parse_refusal("~: 1\n"), HasSubstr("a key is empty"));
  EXPECT_THAT(parse_refusal("a: 1\n---\nb: 2\n"), HasSubstr("a second document"));
  EXPECT_THAT(parse_refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(parse_refusal("# nothing\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(parse_refusal(std::string("a: 1\nb: \0\n", 10)), StartsWith("2:4: a byte 0"));
  EXPECT_THAT(parse_refusal("a: [1, 2\nb: 3\n"), HasSubstr("not YAML"));
}

TEST(YamlGate, AllowsTheDepthLimitAndNotOneMore) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_EQ(parse_refusal(nested(kMaxYamlDepth)), "");
  EXPECT_EQ(parse_refusal(nested(kMaxYamlDepth + 1)), "1:33: nested deeper than 32 levels");
  EXPECT_THAT(parse_refusal(nested(100000)), HasSubstr("nested deeper"));
}

TEST(YamlGate, AnAliasBombEndsAtItsFirstAnchor) {
  std::string bomb = "a: &a [x, x]\n";
  for (char c = 'b'; c < 'z'; ++c)
    bomb += std::string(1, c) + ": &" + c + " [*" + static_cast<char>(c - 1) + ", *" + static_cast<char>(c - 1) + "]\n";
  EXPECT_THAT(parse_refusal(bomb), StartsWith("1:"));
}

TEST(YamlGate, RefusesFilesAndLinesThatAreTooLong) {
  EXPECT_THAT(refusal([] { parse_yaml("a: 1234567890", 8); }), HasSubstr("the file has 13 B; allowed: up to 8 B"));
  EXPECT_THAT(parse_refusal("a: " + std::string(2 << 20, 'x')), HasSubstr("a line of 2.0 MiB"));
}

TEST(YamlReader, TakesPlainDecimalNumbersOnly) {
  const ParamSpec number = spec(ParamType::number);
  EXPECT_EQ(std::get<double>(read("1e-3", number)), 1e-3);
  EXPECT_EQ(std::get<double>(read("-2", number)), -2.0);
  EXPECT_EQ(std::get<double>(read("0.5", number)), 0.5);
  for (const char* bad : {".nan", ".inf", "-.inf", "nan", "inf", "0x10", "010", "-007", "1_000", "1,5", "\"1\"",
                          "1e999", "true", "[1]", "~", "{a: 1}"})
    EXPECT_THAT(read_refusal(bad, number), StartsWith("1:4: p is ")) << bad;
  EXPECT_THAT(read_refusal("010", number), HasSubstr("leading zeros"));
  for (const char* bad : {"1.5", "1e3", "010", "0o7"})
    EXPECT_NE(read_refusal(bad, spec(ParamType::integer)), "") << bad;
}

TEST(YamlReader, SaysWhatWasFoundAndWhatIsAllowed) {
  ParamSpec threshold = spec(ParamType::number, above(0));
  threshold.unit = "m";
  EXPECT_EQ(read_refusal("-1", threshold), "1:4: p is -1; allowed: a number > 0 m");
  EXPECT_EQ(read_refusal("abc", threshold), "1:4: p is 'abc'; allowed: a number > 0 m");
}

TEST(YamlReader, DistinguishesTextFromNumbersByTheQuotes) {
  const ParamSpec text = spec(ParamType::text);
  EXPECT_EQ(std::get<std::string>(read("\"12\"", text)), "12");
  EXPECT_EQ(std::get<std::string>(read("abc", text)), "abc");
  EXPECT_EQ(std::get<std::string>(read("[a, b]", text)), "a, b");
  for (const char* bad : {"12", "true", "1.5", "~", "[1]"}) EXPECT_NE(read_refusal(bad, text), "") << bad;
  EXPECT_NE(read_refusal("\"true\"", spec(ParamType::boolean)), "");
  EXPECT_NE(read_refusal("yes", spec(ParamType::boolean)), "");
}

TEST(YamlReader, PlacesErrorsAtTheElementOfAList) {
  EXPECT_EQ(read_refusal("[1, x]", spec(ParamType::number_list)), "1:8: p[1] is 'x'; allowed: a number");
  EXPECT_EQ(read_refusal("[[1, 2], [3, -4]]", spec(ParamType::number_rows, at_least(0))),
            "1:17: p[1][1] is -4; allowed: a number >= 0");
  EXPECT_EQ(read_refusal("{A: [1, 2, 3]}", spec(ParamType::named_points)),
            "1:8: p.A has 3 numbers; allowed: 2, [x, y]");
}

TEST(YamlReader, UnknownKeysNameTheKnownOnes) {
  const YamlNode root = parse_yaml("kind: a\ntreshold: 1\n");
  YamlMap map(root, "params of iepf");
  map.find("kind");
  map.find("threshold");
  EXPECT_EQ(refusal([&] { map.done(); }),
            "2:1: unknown key 'treshold' in params of iepf; did you mean 'threshold'? known: kind, threshold");
}

TEST(YamlSets, ReplaceAddAndFollowNames) {
  YamlNode root = parse_yaml("a: 1\nlist:\n  - {name: x, v: 1}\n  - {name: y, v: 2}\n");
  apply_sets(root, {"a=2", "list.y.v=[3, 4]", "list.0.v=5", "new.deep.key=6"});
  EXPECT_EQ(root.find("a")->text, "2");
  EXPECT_EQ(root.find("list")->items[1].find("v")->items.size(), 2U);
  EXPECT_EQ(root.find("list")->items[0].find("v")->text, "5");
  EXPECT_EQ(root.find("new")->find("deep")->find("key")->text, "6");
}

TEST(YamlSets, RefusePathsThatLeadNowhere) {
  const auto set = [](const std::string& s) {
    YamlNode root = parse_yaml("a: 1\nlist: [{name: x}]\n");
    return refusal([&] { apply_sets(root, {s}); });
  };
  EXPECT_THAT(set("list.z.v=1"), HasSubstr("list has no element 'z'"));
  EXPECT_THAT(set("a.b=1"), HasSubstr("a is '1', which has no keys"));
  EXPECT_THAT(set("novalue"), HasSubstr("allowed: key=value"));
  EXPECT_THAT(set("=1"), HasSubstr("allowed: key=value"));
  EXPECT_THAT(set("a..b=1"), HasSubstr("a part of the key is empty"));
  EXPECT_THAT(set("a=\"x"), HasSubstr("not YAML"));
  EXPECT_THAT(set("a={b: 1, b: 2}"), HasSubstr("a second time"));
}

bool equal(const YamlNode& a, const YamlNode& b) {
  if (a.kind != b.kind || a.text != b.text || a.items.size() != b.items.size() || a.entries.size() != b.entries.size())
    return false;
  for (std::size_t i = 0; i < a.items.size(); ++i)
    if (!equal(a.items[i], b.items[i])) return false;
  for (std::size_t i = 0; i < a.entries.size(); ++i)
    if (a.entries[i].key != b.entries[i].key || !equal(a.entries[i].value, b.entries[i].value)) return false;
  return true;
}

YamlNode random_tree(CounterRng& rng, int depth) {
  static const std::vector<std::string> kTexts = {
      "plain", "",   "true", "12",    "a: b", "- x", "#no", "\"quoted\"", "line\nbreak", "tab\t", "\x01",
      "ü",     "~",  "null", " lead", "'",    "\\",  "1e3", "[",          "{",           "yes",   "a,b",
      "*x",    "&x", "!t",   "%",     "@",    "?",   "- ",  "...",        "---"};
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n)); };
  const std::size_t kind = depth > 4 ? 0 : pick(4);
  if (kind <= 1) return pick(3) == 0 ? yaml_number(rng.normal()) : yaml_text(kTexts[pick(kTexts.size())]);
  YamlNode node = kind == 2 ? yaml_sequence() : yaml_map();
  const std::size_t n = pick(5);
  for (std::size_t i = 0; i < n; ++i) {
    YamlNode child = random_tree(rng, depth + 1);
    if (kind == 2)
      node.items.push_back(std::move(child));
    else
      yaml_add(node, std::to_string(i) + kTexts[pick(kTexts.size())], std::move(child));
  }
  return node;
}

TEST(YamlWriter, AnyTreeReadsBackEqual) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    CounterRng rng(seed, RngStream::resampling);
    YamlNode root = yaml_map();
    yaml_add(root, "root", random_tree(rng, 0));
    const std::string text = write_yaml(root);
    YamlNode back;
    ASSERT_NO_THROW(back = parse_yaml(text)) << text;
    EXPECT_TRUE(equal(root, back)) << text;
    EXPECT_EQ(write_yaml(back), text);
  }
}

TEST(ParseYaml, BoundsTheKeysOfAMapAndTheValuesOfAFile) {
  std::string keys;
  for (std::size_t i = 0; i <= kMaxYamlKeys; ++i) keys += "k" + std::to_string(i) + ": 1\n";
  EXPECT_EQ(parse_refusal(keys), std::to_string(kMaxYamlKeys + 1) + ":1: a map of more than 100000 keys");
  std::string values;
  for (std::size_t i = 0; i <= kMaxYamlNodes / 1000; ++i) {
    values += "- [1";
    for (int k = 1; k < 1000; ++k) values += ",1";
    values += "]\n";
  }
  EXPECT_THAT(parse_refusal(values), HasSubstr("more than 2000000 values in a file"));
}

}  // namespace
}  // namespace scanbench::io
