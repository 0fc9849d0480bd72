// Writes and reads manifest.json, and describes the build.
#include "harness/store/manifest.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/files/hash.hpp"
#include "harness/store/json_file.hpp"
#include "scanbench_version.hpp"  // included here and nowhere else: it changes with every commit

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

std::string cpu_name() {
  const std::string info = read_file("/proc/cpuinfo");
  const auto at = info.find("model name");
  if (at == std::string::npos) return "unknown";
  const auto colon = info.find(": ", at);
  return colon == std::string::npos ? "unknown" : info.substr(colon + 2, info.find('\n', colon) - colon - 2);
}

/// Converts "name 1.2,other 3.4" to an object.
Json libraries() {
  Json json = Json::object();
  std::string_view rest = version::kLibraries;
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), item.size() + 1));
    const auto blank = item.find(' ');
    if (blank != std::string_view::npos) json[std::string(item.substr(0, blank))] = item.substr(blank + 1);
  }
  return json;
}

/// Hashes that are known, and since when: a file that was written before then has not changed.
struct KnownHashes {
  std::map<std::string, std::string> hashes;
  fs::file_time_type since = fs::file_time_type::min();
};

using Hashes = std::map<std::string, std::string>;  // by path, relative to the run

/// The SHA-256 of every file of the run but the manifest.
Hashes artefacts(const fs::path& run, const KnownHashes& known = {}) {
  Hashes hashes;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const fs::path relative = entry.path().lexically_relative(run);
    if (!entry.is_regular_file() || !is_run_file(relative) || relative == kManifestFile.name()) continue;
    const std::string path = relative.generic_string();
    const auto hash = known.hashes.find(path);
    const bool is_known = hash != known.hashes.end() &&
                          (known.since == fs::file_time_type::max() || fs::last_write_time(entry.path()) < known.since);
    hashes.emplace(path, is_known ? hash->second : sha256_of_file(entry.path()));
  }
  return hashes;
}

/// Everything but the files.
Json manifest_json(const fs::path& run) {
  const fs::path file = run / kManifestFile;
  std::error_code absent;
  if (!fs::exists(file, absent)) throw ConfigError(run.string() + ": not the folder of a run: it has no manifest.json");
  Json json = load_json_object(file, "artefacts");
  if (json.value("program", Json()) != "scanbench")
    throw ConfigError(file.string() + ": not the manifest of a scanbench run");
  if (json.value("schema", Json()) != 1)
    throw ConfigError(file.string() + ": schema is " + json.value("schema", Json()).dump() + "; allowed: 1");
  return json;
}

/// Collects the paths and hashes of the key `artefacts`. A run of 10^5 cells has half a million of them: as JSON values
/// they would take a gigabyte.
class ArtefactReader : public nlohmann::json_sax<Json> {
 public:
  Hashes take() { return std::move(hashes_); }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& text) override {
    if (depth_ == 3 && key_ == "path") path_ = text;
    if (depth_ == 3 && key_ == "sha256") sha256_ = text;
    return true;
  }
  bool key(string_t& text) override {
    if (depth_ == 1) is_artefacts_ = text == "artefacts";
    key_ = text;
    return true;
  }
  bool start_object(std::size_t) override { return ++depth_ < kDeepest; }
  bool end_object() override {
    if (depth_-- == 3 && is_artefacts_ && !path_.empty()) hashes_.emplace(std::move(path_), std::move(sha256_));
    path_.clear();
    sha256_.clear();
    return true;
  }
  bool start_array(std::size_t) override { return ++depth_ < kDeepest; }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  static constexpr int kDeepest = 32;
  int depth_ = 0;
  bool is_artefacts_ = false;
  std::string key_, path_, sha256_;
  Hashes hashes_;
};

Hashes hashes_in_manifest(const fs::path& run) {
  ArtefactReader reader;
  Json::sax_parse(read_file(run / kManifestFile), &reader);
  return reader.take();
}

/// Writes the file as Json::dump() would, without holding the list of files as JSON values.
void write_json(const fs::path& run, const Json& json, const Hashes& hashes) {
  std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  text.resize(text.rfind("\n}"));
  text += ",\n  \"artefacts\": [";
  for (const auto& [path, hash] : hashes) {
    const std::string name = Json(path).dump(-1, ' ', false, Json::error_handler_t::replace);
    text += (text.back() == '[' ? "\n    {\n      \"path\": " : ",\n    {\n      \"path\": ") + name +
            ",\n      \"sha256\": \"" + hash + "\"\n    }";
  }
  write_file_atomically(run / kManifestFile, text + (hashes.empty() ? "]\n}\n" : "\n  ]\n}\n"));
}

}  // namespace

const std::string& code_version() {
  static const std::string hash = sha256_of_file_without("/proc/self/exe", version::kCommit);
  return hash;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

void write_manifest(const fs::path& run, const Manifest& manifest) {
  std::set<std::uint64_t> seeds;
  Json cells = Json::array();
  for (const auto& cell : manifest.cells) {
    seeds.insert(cell.seed);
    cells.push_back({{"scenario", cell.scenario}, {"pipeline", cell.pipeline}, {"seed", cell.seed}});
  }
  Json json{{"schema", 1},
            {"program", "scanbench"},
            {"state", manifest.state},
            {"version", version::kVersion},
            {"git_commit", std::string(version::kCommit)},
            {"code_version", code_version()},
            {"compiler", version::kCompiler},
            {"build_type", version::kBuildType},
            {"flags", version::kFlags},
            {"libraries", libraries()},
            {"cpu", cpu_name()},
            {"argv", manifest.argv},
            {"seeds", seeds},
            {"start", manifest.start},
            {"end", manifest.end},
            {"scenarios", manifest.scenarios},
            {"isolation", manifest.isolation},
            {"foreign_modules", manifest.foreign_modules},
            {"cells", cells}};
  write_json(run, json,
             manifest.state == "running" ? Hashes() : artefacts(run, {manifest.verified, fs::file_time_type::max()}));
}

Manifest load_manifest(const fs::path& run) {
  const Json json = manifest_json(run);
  try {
    Manifest manifest{json.at("state"),
                      json.at("start"),
                      json.at("end"),
                      json.at("argv"),
                      json.at("scenarios"),
                      {},
                      {},
                      json.value("isolation", std::vector<std::string>{}),
                      json.value("foreign_modules", std::vector<std::string>{})};
    for (const auto& scenario : manifest.scenarios) check_name("scenario", scenario);
    for (const auto& cell : json.at("cells")) {
      manifest.cells.push_back({cell.at("scenario"), cell.at("pipeline"), cell.at("seed")});
      check_name("scenario", manifest.cells.back().scenario);
      check_name("pipeline", manifest.cells.back().pipeline);
    }
    return manifest;
  } catch (const Json::exception& e) {
    refuse_json(run / kManifestFile, e);
  }
}

std::map<std::string, std::string> listed_hashes(const fs::path& run) {
  manifest_json(run);  // refuses what is no manifest
  return hashes_in_manifest(run);
}

void refresh_manifest(const fs::path& run) {
  constexpr auto kClock = std::chrono::seconds(1);  // more than the grain of any file system's times
  const Json json = manifest_json(run);
  const KnownHashes known{hashes_in_manifest(run), fs::last_write_time(run / kManifestFile) - kClock};
  write_json(run, json, artefacts(run, known));
}

void set_run_state(const fs::path& run, const std::string& state) {
  Json json = manifest_json(run);
  json["state"] = state;
  write_json(run, json, hashes_in_manifest(run));
}

std::string version_text() {
  // Keeps twelve of the commit's 40 digits, and the suffix "-dirty-" with a hash of the code.
  std::string commit = version::kCommit;
  if (commit.size() >= 40 && !commit.starts_with("unknown")) commit.erase(12, 28);
  return std::string("scanbench ") + version::kVersion + " (" + commit + ", " + version::kCompiler + ", " +
         version::kBuildType + ")";
}

Provenance load_provenance(const fs::path& run) try {
  const Json json = manifest_json(run);
  const auto text = [&](const char* key) { return json.value(key, std::string()); };
  std::vector<std::string> words = json.value("argv", std::vector<std::string>());
  std::vector<std::string> used;
  const Json libraries = json.value("libraries", Json::object());  // items() keeps a reference to it
  for (const auto& [name, number] : libraries.items()) used.push_back(name + " " + number.get<std::string>());
  return {.commit = text("git_commit"),
          .compiler = text("compiler") + ", " + text("build_type") + ", " + text("flags"),
          .libraries = join(used),
          .processor = text("cpu"),
          .start = text("start"),
          .command = join(words, " ")};
} catch (const Json::exception& e) {
  refuse_json(run / kManifestFile, e);
}

std::vector<std::pair<std::string, std::string>> manifest_facts(const fs::path& run) try {
  const Json json = manifest_json(run);
  const Provenance made_by = load_provenance(run);
  return {{"command", made_by.command},
          {"version", json.value("version", std::string()) + ", commit " + made_by.commit},
          {"started", made_by.start},
          {"ended", json.value("end", std::string())},
          {"compiler", made_by.compiler},
          {"libraries", made_by.libraries},
          {"processor", made_by.processor},
          {"files", "effective.yaml holds every parameter; manifest.json the SHA-256 of every file"}};
} catch (const Json::exception& e) {
  refuse_json(run / kManifestFile, e);
}

}  // namespace scanbench::harness
