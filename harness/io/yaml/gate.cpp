// Builds the tree from yaml-cpp's events and refuses the parts of YAML that scenarios do not use.
#include "harness/io/yaml/gate.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <unordered_map>

#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

// yaml-cpp reads a whole line ahead if it begins with a bracket. This bounds the cost.
constexpr std::size_t kMaxLineBytes = std::size_t{1} << 20;

Mark mark_of(const YAML::Mark& mark) {
  return {mark.line + 1, mark.column + 1};
}

class TreeBuilder : public YAML::EventHandler {
 public:
  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    if (expects_key()) throw PlacedError(mark_of(mark), "a key is empty; allowed: a word");
    add(YamlKind::null, mark);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw PlacedError(mark_of(mark), "an alias (*name); allowed: values written out");
  }

  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    throw PlacedError(mark_of(mark), "an anchor (&" + name + "); allowed: values written out");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    if (expects_key()) {
      take_key(mark, value);
      return;
    }
    YamlNode& node = add(YamlKind::scalar, mark);
    node.quoted = tag == "!";
    node.text = value;
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlKind::sequence, mark, tag, anchor);
  }
  void OnSequenceEnd() override { open_.pop_back(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlKind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct Open {
    YamlNode* node;  // stays valid: the vector that holds it grows only after this node is closed
    bool has_key = false;
    std::unordered_map<std::string, int> lines;  // of the keys seen
  };

  bool expects_key() const {
    return !open_.empty() && open_.back().node->kind == YamlKind::map && !open_.back().has_key;
  }

  void take_key(const YAML::Mark& mark, const std::string& key) {
    if (key == "<<") throw PlacedError(mark_of(mark), "a merge key (<<); allowed: keys written out");
    const auto [earlier, is_new] = open_.back().lines.emplace(key, mark.line + 1);
    if (!is_new)
      throw PlacedError(mark_of(mark), fmt::format("the key {} occurs a second time; the first is in line {}",
                                                   quoted_excerpt(key), earlier->second));
    if (open_.back().lines.size() > kMaxYamlKeys)
      throw PlacedError(mark_of(mark), fmt::format("a map of more than {} keys", kMaxYamlKeys));
    open_.back().node->entries.push_back({key, mark_of(mark), {}});
    open_.back().has_key = true;
  }

  YamlNode& add(YamlKind kind, const YAML::Mark& mark) {
    if (++nodes_ > kMaxYamlNodes)
      throw PlacedError(mark_of(mark), fmt::format("more than {} values in a file", kMaxYamlNodes));
    YamlNode* node = &root_;
    if (!open_.empty()) {
      Open& parent = open_.back();
      if (parent.node->kind == YamlKind::map) {
        node = &parent.node->entries.back().value;
        parent.has_key = false;
      } else {
        node = &parent.node->items.emplace_back();
      }
    }
    node->kind = kind;
    node->mark = mark_of(mark);
    return *node;
  }

  void open(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    if (expects_key()) throw PlacedError(mark_of(mark), "a key is a list or a map; allowed: a word");
    if (open_.size() >= static_cast<std::size_t>(kMaxYamlDepth))
      throw PlacedError(mark_of(mark), fmt::format("nested deeper than {} levels", kMaxYamlDepth));
    open_.push_back({&add(kind, mark), false, {}});
  }

  static void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) throw PlacedError(mark_of(mark), "an anchor (&name); allowed: values written out");
  }

  // The parser's tag is "?" for plain and "!" for quoted values without a tag.
  static void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!")
      throw PlacedError(mark_of(mark), "a tag (" + quoted_excerpt(tag) + "); allowed: values without tags");
  }

  YamlNode root_;
  std::vector<Open> open_;
  std::size_t nodes_ = 0;
};

void check_bytes(std::string_view text, std::size_t max_bytes) {
  if (text.size() > max_bytes)
    throw PlacedError({1, 1},
                      fmt::format("the file has {}; allowed: up to {}", size_text(static_cast<double>(text.size())),
                                  size_text(static_cast<double>(max_bytes))));
  int number = 1;
  for (std::string_view rest = text; !rest.empty(); ++number) {
    const std::string_view line = take_line(rest);
    if (const std::size_t nul = line.find('\0'); nul != std::string_view::npos)
      throw PlacedError({number, static_cast<int>(nul) + 1}, "a byte 0: this is not a text file in UTF-8");
    if (line.size() > kMaxLineBytes)
      throw PlacedError({number, 1},
                        fmt::format("a line of {}; allowed: up to {}", size_text(static_cast<double>(line.size())),
                                    size_text(static_cast<double>(kMaxLineBytes))));
  }
}

}  // namespace

YamlNode::YamlNode() = default;
YamlNode::YamlNode(const YamlNode&) = default;
YamlNode::YamlNode(YamlNode&&) noexcept = default;
YamlNode& YamlNode::operator=(const YamlNode&) = default;
YamlNode& YamlNode::operator=(YamlNode&&) noexcept = default;
YamlNode::~YamlNode() = default;

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto it = std::ranges::find(entries, key, &YamlEntry::key);
  return it == entries.end() ? nullptr : &it->value;
}

YamlNode* YamlNode::find(std::string_view key) {
  const auto it = std::ranges::find(entries, key, &YamlEntry::key);
  return it == entries.end() ? nullptr : &it->value;
}

YamlNode parse_yaml(std::string_view text, std::size_t max_bytes) {
  check_bytes(text, max_bytes);
  TreeBuilder builder;
  std::istringstream stream{std::string(text)};
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder))
      throw PlacedError({1, 1}, "the file is empty; allowed: keys and values, the first one schema: 1");

    class SecondDocument : public TreeBuilder {
      void OnDocumentStart(const YAML::Mark& mark) override {
        throw PlacedError(mark_of(mark), "a second document begins; allowed: one document per file");
      }
    } second;
    while (parser.HandleNextDocument(second)) {
    }
  } catch (const YAML::Exception& error) {
    const bool maybe_variable =
        error.msg.find("flow") != std::string::npos && text.find("${") != std::string_view::npos;
    throw PlacedError(mark_of(error.mark),
                      "not YAML: " + error.msg +
                          (maybe_variable ? "; between { and }, a path with ${SCANBENCH_DATA} needs quotes" : ""));
  }
  return builder.take_root();
}

}  // namespace scanbench::io
