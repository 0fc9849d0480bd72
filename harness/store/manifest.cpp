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

Json artefacts(const fs::path& run, const KnownHashes& known = {}) {
  std::set<std::string> paths;  // in a fixed order
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const fs::path relative = entry.path().lexically_relative(run);
    if (entry.is_regular_file() && is_run_file(relative) && relative != kManifestFile.name())
      paths.insert(relative.generic_string());
  }
  Json list = Json::array();
  for (const auto& path : paths) {
    const auto hash = known.hashes.find(path);
    const bool is_known = hash != known.hashes.end() && fs::last_write_time(run / path) < known.since;
    list.push_back({{"path", path}, {"sha256", is_known ? hash->second : sha256_of_file(run / path)}});
  }
  return list;
}

Json manifest_json(const fs::path& run) {
  const fs::path file = run / kManifestFile;
  std::error_code absent;
  if (!fs::exists(file, absent)) throw ConfigError(run.string() + ": not the folder of a run: it has no manifest.json");
  Json json = load_json_object(file);
  if (json.value("program", Json()) != "scanbench")
    throw ConfigError(file.string() + ": not the manifest of a scanbench run");
  if (json.value("schema", Json()) != 1)
    throw ConfigError(file.string() + ": schema is " + json.value("schema", Json()).dump() + "; allowed: 1");
  return json;
}

std::map<std::string, std::string> hashes_in(const Json& manifest, const fs::path& run) try {
  std::map<std::string, std::string> hashes;
  for (const auto& file : manifest.at("artefacts")) hashes.emplace(file.at("path"), file.at("sha256"));
  return hashes;
} catch (const Json::exception& e) {
  refuse_json(run / kManifestFile, e);
}

void write_json(const fs::path& run, const Json& json) {
  write_file_atomically(run / kManifestFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

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
            {"git_commit", version::kCommit},
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
            {"cells", cells},
            {"artefacts", manifest.state == "running" ? Json::array() : artefacts(run)}};
  write_json(run, json);
}

Manifest load_manifest(const fs::path& run) {
  const Json json = manifest_json(run);
  try {
    Manifest manifest{json.at("state"), json.at("start"), json.at("end"), json.at("argv"), json.at("scenarios"), {}};
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
  return hashes_in(manifest_json(run), run);
}

void refresh_manifest(const fs::path& run) {
  constexpr auto kClock = std::chrono::seconds(1);  // more than the grain of any file system's times
  Json json = manifest_json(run);
  const KnownHashes known{hashes_in(json, run), fs::last_write_time(run / kManifestFile) - kClock};
  json["artefacts"] = artefacts(run, known);
  write_json(run, json);
}

void set_run_state(const fs::path& run, const std::string& state) {
  Json json = manifest_json(run);
  json["state"] = state;
  write_json(run, json);
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
