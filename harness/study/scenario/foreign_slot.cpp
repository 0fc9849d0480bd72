// Reads and writes slots of foreign modules.
#include "harness/study/scenario/foreign_slot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/names.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/writer.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/inspect.hpp"

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgramForm = "a list: the program and its arguments, like [python3, my_lines.py]";

/// Runs `work`; faults of the module get the place of the node.
template <class Work>
auto at_node(const io::YamlNode& node, Work&& work) {
  try {
    return work();
  } catch (const ForeignFault& fault) {
    throw io::PlacedError(node.mark, fault.what());
  }
}

/// A word as a path, relative to the file it is written in.
fs::path path_of(const io::YamlNode& node, const std::string& word, const fs::path& file) {
  const fs::path base = node.mark.line == 0 ? fs::path() : file.parent_path();
  return fs::absolute(base / word).lexically_normal();
}

/// The file that a word means; nullopt if there is no such regular file.
std::optional<fs::path> file_of(const io::YamlNode& node, const std::string& word, const fs::path& file) {
  const fs::path path = path_of(node, word, file);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  return path;
}

/// For a word that means no regular file.
[[noreturn]] void refuse_file(const io::YamlNode& node, const std::string& word, const fs::path& file,
                              const std::string& advice = "") {
  std::error_code error;
  if (fs::exists(path_of(node, word, file), error))
    throw io::PlacedError(node.mark, word + ": not a regular file; allowed: a file on disk");
  throw io::PlacedError(node.mark, "no such file: " + word + advice);
}

HashedFile hashed(const fs::path& path) {
  return {path, io::sha256_of_file(path)};
}

std::vector<std::string> read_words(const io::YamlNode& node, std::string_view name, const char* allowed) {
  if (node.kind == io::YamlKind::scalar) return {io::read_word(node, name, allowed)};
  std::vector<std::string> words;
  for (const io::YamlNode& item : io::read_list(node, name, allowed))
    words.push_back(io::read_word(item, "a word", allowed));
  if (words.empty()) throw io::PlacedError(node.mark, fmt::format("{} is empty; allowed: {}", name, allowed));
  return words;
}

/// Arguments that are files become absolute paths, because a run folder keeps them.
void read_program(const io::YamlNode& node, const ModuleSources& sources, ForeignSource& source) {
  source.program = read_words(node, "program", kProgramForm);
  if (sources.is_recorded) return;
  for (std::size_t i = 0; i < source.program.size(); ++i) {
    std::string& word = source.program[i];
    const bool in_path = i == 0 && word.find('/') == std::string::npos;  // as the shell does
    if (in_path) continue;
    if (const auto path = file_of(node, word, sources.file)) {
      source.files.push_back(hashed(*path));
      word = path->string();
    } else if (i == 0) {
      refuse_file(node, word, sources.file);
    }
  }
}

void read_more_files(io::YamlMap& map, const ModuleSources& sources, ForeignSource& source) {
  const io::YamlNode* node = map.find("files");
  if (node == nullptr) return;
  constexpr const char* kForm = "a list of files that the program reads";
  for (const std::string& word : read_words(*node, "files", kForm)) {
    const auto path = sources.is_recorded ? fs::path(word) : file_of(*node, word, sources.file);
    if (!path) refuse_file(*node, word, sources.file);
    source.more_files.push_back(path->string());
    if (!sources.is_recorded) source.files.push_back(hashed(*path));
  }
}

/// One hash of all files.
std::string hash_of(const ForeignSource& source) {
  if (source.files.size() == 1) return source.files.front().sha256;
  io::Sha256 hash;
  for (const HashedFile& file : source.files) hash.part("file", file.sha256);
  return hash.hex();
}

std::string identity_text(const std::string& name, const std::string& version, const std::string& sha256) {
  return fmt::format("{} {} with SHA-256 {}", name, version.empty() ? "without version" : version,
                     sha256.substr(0, 12));
}

/// Checks or takes over what effective.yaml says about the module.
void read_identity(const io::YamlNode& node, bool is_recorded, ForeignSource& source) {
  io::YamlMap map(node, "identity");
  const std::string name = map.text("name", "the module's name");
  const std::string version = map.text_or("version", "");
  const std::string sha256 = map.text("sha256", "the hash of its files");
  const std::string summary = map.text_or("summary", "");
  const std::string reference = map.text_or("reference", "");
  map.done();
  if (is_recorded) {
    source.module.info = {name, summary, reference};
    source.module.version = version;
    source.files = {{"", sha256}};
    return;
  }
  const ForeignModule& module = source.module;
  if (name != module.info.name || version != module.version || sha256 != hash_of(source))
    throw io::PlacedError(node.mark,
                          fmt::format("the module is now {}, and the identity in this file is {}; remove the key "
                                      "to accept the present one",
                                      identity_text(module.info.name, module.version, hash_of(source)),
                                      identity_text(name, version, sha256)));
}

/// A parameter of a recorded file in the type that its text suggests, because there is no specification.
ParamValue plain_value(const io::YamlNode& node) {
  ParamSpec spec;
  spec.name = "a parameter";
  const auto is_list_of = [&](io::YamlKind kind) {
    return node.kind == io::YamlKind::sequence &&
           std::ranges::all_of(node.items, [kind](const io::YamlNode& item) { return item.kind == kind; });
  };
  spec.type = ParamType::text;
  if (node.kind == io::YamlKind::map) spec.type = ParamType::named_points;
  if (is_list_of(io::YamlKind::scalar)) spec.type = ParamType::number_list;
  if (is_list_of(io::YamlKind::sequence) && !node.items.empty()) spec.type = ParamType::number_rows;
  if (node.kind == io::YamlKind::scalar && !node.quoted) {
    if (node.text == "true" || node.text == "false") spec.type = ParamType::boolean;
    if (const auto number = parse_number(node.text))
      spec.type =
          node.text.find_first_not_of("+-0123456789") == std::string::npos ? ParamType::integer : ParamType::number;
  }
  return io::read_param(node, spec);
}

void read_params(io::YamlMap& map, bool is_recorded, ModuleChoice& choice) {
  const io::YamlNode* node = map.find("params");
  if (is_recorded) {
    if (node != nullptr)
      for (const auto& entry : node->entries) choice.params.emplace(entry.key, plain_value(entry.value));
    return;
  }
  const std::vector<ParamSpec>& specs = choice.source->module.params;
  if (node != nullptr) {
    io::YamlMap params(*node, "params of " + choice.module);
    choice.params = params.params(specs);
    params.done();
  }
  choice.params = resolve(specs, choice.params);
}

/// The module of a library. Throws PlacedError if it has none of this name and kind.
ForeignSource module_in(const std::vector<ForeignSource>& modules, const io::YamlNode& node, const std::string& kind,
                        const std::string& name) {
  std::vector<std::string> known;
  for (const ForeignSource& source : modules) {
    if (source.module.kind == kind && source.module.info.name == name) return source;
    known.push_back(source.module.kind + " " + source.module.info.name);
  }
  throw io::PlacedError(node.mark, fmt::format("the library has no {} {}; it has: {}", kind, io::quoted_excerpt(name),
                                               fmt::join(known, ", ")));
}

ForeignSource read_library_slot(io::YamlMap& map, const io::YamlNode& node, const std::string& kind,
                                const ModuleSources& sources) {
  const std::string name = map.text("module", "a name");
  const io::YamlNode* plugin = map.find("plugin");
  if (plugin == nullptr) return module_in(sources.libraries, node, kind, name);
  const std::string word = map.text("plugin", "a shared library");
  ForeignSource source;
  if (sources.is_recorded) {
    source.library = word;
    return source;
  }
  const auto path = file_of(*plugin, word, sources.file);
  if (!path) refuse_file(*plugin, word, sources.file);
  return module_in(at_node(*plugin, [&] { return inspect_library(*path); }), node, kind, name);
}

ForeignSource read_program_slot(io::YamlMap& map, const io::YamlNode& node, const std::string& kind,
                                const ModuleSources& sources) {
  ForeignSource source;
  read_program(node, sources, source);
  read_more_files(map, sources, source);
  ParamSpec seconds;
  seconds.name = "scan_seconds";
  seconds.bounds = above(0);
  seconds.unit = "s";
  if (const io::YamlNode* limit = map.find(seconds.name))
    source.scan_seconds = std::get<double>(io::read_param(*limit, seconds));
  if (sources.is_recorded) return source;
  at_node(node, [&] { inspect_program(source, sources.sandbox); });
  if (source.module.kind != kind)
    throw io::PlacedError(node.mark, fmt::format("the program `{}` is a module of the kind {}; allowed here: {}",
                                                 source.text(), source.module.kind, kind));
  return source;
}

/// An entry of `plugins`: a file, or {file: FILE, built_by: COMMAND}.
struct NamedLibrary {
  const io::YamlNode* node = nullptr;
  std::string file;
  std::string built_by;
};

std::vector<NamedLibrary> read_libraries(const io::YamlNode& node) {
  constexpr const char* kForm = "a list of shared libraries, each a file or {file: ..., built_by: a command}";
  if (node.kind == io::YamlKind::scalar) return {{&node, io::read_word(node, "plugins", kForm), ""}};
  std::vector<NamedLibrary> libraries;
  for (const io::YamlNode& item : io::read_list(node, "plugins", kForm)) {
    NamedLibrary library{&item, "", ""};
    if (item.kind == io::YamlKind::map) {
      io::YamlMap map(item, "a library of plugins");
      library.file = map.text("file", "a shared library");
      library.built_by = map.text_or("built_by", "");
      map.done();
    } else {
      library.file = io::read_word(item, "a library", kForm);
    }
    libraries.push_back(std::move(library));
  }
  if (libraries.empty()) throw io::PlacedError(node.mark, fmt::format("plugins is empty; allowed: {}", kForm));
  return libraries;
}

/// The modules of a library. A fault names the command that builds the library.
std::vector<ForeignSource> modules_of(const NamedLibrary& library, const fs::path& file) {
  const std::string advice = library.built_by.empty() ? "" : fmt::format("; `{}` builds it", library.built_by);
  const auto path = file_of(*library.node, library.file, file);
  if (!path) refuse_file(*library.node, library.file, file, advice);
  try {
    return inspect_library(*path);
  } catch (const ForeignFault& fault) {
    throw io::PlacedError(library.node->mark, fault.what() + advice);
  }
}

}  // namespace

std::vector<ForeignSource> read_plugins(io::YamlMap& map, const ModuleSources& sources) {
  std::vector<ForeignSource> modules;
  const io::YamlNode* node = map.find("plugins");
  if (node == nullptr || sources.is_recorded) return modules;
  for (const NamedLibrary& library : read_libraries(*node)) {
    for (ForeignSource& source : modules_of(library, sources.file)) {
      const auto is_same = [&](const ForeignSource& other) {
        return other.module.kind == source.module.kind && other.module.info.name == source.module.info.name;
      };
      if (std::ranges::any_of(modules, is_same))
        throw io::PlacedError(library.node->mark,
                              fmt::format("two libraries have a {} {}", source.module.kind, source.module.info.name));
      modules.push_back(std::move(source));
    }
  }
  return modules;
}

bool is_foreign_slot(const io::YamlNode& node, const std::string& kind, const ModuleSources& sources) {
  if (node.find("program") != nullptr || node.find("plugin") != nullptr) return true;
  const io::YamlNode* name = node.find("module");
  return name != nullptr && std::ranges::any_of(sources.libraries, [&](const ForeignSource& source) {
           return source.module.kind == kind && source.module.info.name == name->text;
         });
}

ModuleChoice read_foreign_slot(const io::YamlNode& node, const std::string& kind, const std::string& what,
                               const ModuleSources& sources) {
  io::YamlMap map(node, what);
  ModuleChoice choice;
  choice.kind = kind;
  const io::YamlNode* program = map.find("program");
  choice.source = program != nullptr ? read_program_slot(map, *program, kind, sources)
                                     : read_library_slot(map, node, kind, sources);
  choice.source->module.kind = kind;
  const io::YamlNode* identity = map.find("identity");
  if (identity != nullptr) read_identity(*identity, sources.is_recorded, *choice.source);
  choice.module = choice.source->module.info.name;
  read_params(map, sources.is_recorded, choice);
  map.done();
  return choice;
}

io::YamlNode foreign_slot_node(const ModuleChoice& choice) {
  const ForeignSource& source = *choice.source;
  io::YamlNode map = io::yaml_map();
  if (source.program.empty()) {
    io::yaml_add(map, "module", io::yaml_text(choice.module));
    io::yaml_add(map, "plugin", io::yaml_text(source.library.string()));
  } else {
    io::YamlNode& words = io::yaml_add(map, "program", io::yaml_sequence());
    for (const auto& word : source.program) words.items.push_back(io::yaml_text(word));
    if (!source.more_files.empty()) {
      io::YamlNode& files = io::yaml_add(map, "files", io::yaml_sequence());
      for (const auto& file : source.more_files) files.items.push_back(io::yaml_text(file));
    }
    io::yaml_add(map, "scan_seconds", io::yaml_number(source.scan_seconds));
  }
  io::YamlNode& identity = io::yaml_add(map, "identity", io::yaml_map());
  io::yaml_add(identity, "name", io::yaml_text(source.module.info.name));
  io::yaml_add(identity, "version", io::yaml_text(source.module.version));
  io::yaml_add(identity, "sha256", io::yaml_text(hash_of(source)));
  io::yaml_add(identity, "summary", io::yaml_text(source.module.info.summary));
  io::yaml_add(identity, "reference", io::yaml_text(source.module.info.reference));
  io::yaml_add(map, "params", io::to_yaml(choice.params));
  return map;
}

ForeignSource without_folders(ForeignSource source) {
  const auto name_of = [](const std::string& path) { return fs::path(path).filename().string(); };
  for (std::string& word : source.program)
    if (word.starts_with('/')) word = name_of(word);
  for (std::string& file : source.more_files) file = name_of(file);
  source.library = source.library.filename();
  return source;
}

}  // namespace scanbench::study
