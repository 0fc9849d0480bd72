// Writes and reads manifest.json and artefacts.sha256, and describes the build.
#include "harness/runs/store/manifest.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/names.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/hash_list.hpp"
#include "harness/runs/store/json_file.hpp"
#include "scanbench_version.hpp"  // included here and nowhere else: it changes with every commit

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

std::string cpu_name() {
  const std::string info = io::read_file("/proc/cpuinfo");
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

constexpr const char* kListHash = "artefacts_sha256";  // the key; absent while there is no list

/// Hashes that are known, and since when: a file that was written before then has not changed.
struct KnownHashes {
  io::FileHashes hashes;
  fs::file_time_type since = fs::file_time_type::min();
};

/// The SHA-256 of every file of the run but the manifest and the list.
io::FileHashes artefacts(const fs::path& run, const KnownHashes& known) {
  io::FileHashes hashes;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const fs::path relative = entry.path().lexically_relative(run);
    if (!entry.is_regular_file() || !is_run_file(relative)) continue;
    const std::string path = relative.generic_string();
    if (path == kManifestFile.name() || path == kArtefactsFile.name()) continue;
    const auto hash = known.hashes.find(path);
    const bool is_known = hash != known.hashes.end() &&
                          (known.since == fs::file_time_type::max() || fs::last_write_time(entry.path()) < known.since);
    hashes.emplace(path, is_known ? hash->second : io::sha256_of_file(entry.path()));
  }
  return hashes;
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

/// The list that the manifest names; nothing if it names none, or if that is not the one in the folder.
std::optional<io::FileHashes> named_list(const fs::path& run, const Json& manifest) {
  const fs::path file = run / kArtefactsFile;
  if (!manifest.contains(kListHash) || !fs::exists(file)) return std::nullopt;
  const std::string text = io::read_file(file);
  if (manifest.at(kListHash) != io::sha256_hex(text)) return std::nullopt;
  return io::parse_hash_list(text, file.string());
}

void write_json(const fs::path& run, const Json& json) {
  io::write_file_atomically(run / kManifestFile, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// Writes the list of files, then the manifest that names it. The manifest in the folder names none.
void write_with_list(const fs::path& run, Json manifest, const io::FileHashes& files) {
  const std::string list = io::hash_list(files);
  io::write_file_atomically(run / kArtefactsFile, list);
  manifest[kListHash] = io::sha256_hex(list);
  write_json(run, manifest);
}

}  // namespace

const std::string& code_version() {
  static const std::string hash = io::sha256_of_file_without("/proc/self/exe", version::kCommit);
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
            {"sandbox", manifest.sandbox},
            {"without_sandbox", manifest.without_sandbox},
            {"foreign_modules", manifest.foreign_modules},
            {"cells", cells}};
  if (manifest.state != "running") {
    write_with_list(run, std::move(json), artefacts(run, {manifest.verified, fs::file_time_type::max()}));
    return;
  }
  write_json(run, json);
  io::remove_file(run / kArtefactsFile);
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
                      json.value("sandbox", decltype(Manifest::sandbox){}),
                      json.value("without_sandbox", std::vector<std::string>{}),
                      json.value("foreign_modules", std::vector<std::string>{})};
    for (const auto& scenario : manifest.scenarios) io::check_name("scenario", scenario);
    for (const auto& cell : json.at("cells")) {
      manifest.cells.push_back({cell.at("scenario"), cell.at("pipeline"), cell.at("seed")});
      io::check_name("scenario", manifest.cells.back().scenario);
      io::check_name("pipeline", manifest.cells.back().pipeline);
    }
    return manifest;
  } catch (const Json::exception& e) {
    refuse_json(run / kManifestFile, e);
  }
}

io::FileHashes listed_hashes(const fs::path& run) {
  const Json json = manifest_json(run);
  if (!json.contains(kListHash)) return {};
  if (auto list = named_list(run, json)) return *std::move(list);
  throw ConfigError((run / kArtefactsFile).string() +
                    " is missing or is not the list of files that manifest.json names, so that undamaged cells cannot "
                    "be told from others; a run without --resume makes all of them");
}

void refresh_manifest(const fs::path& run) {
  constexpr auto kClock = std::chrono::seconds(1);  // more than the grain of any file system's times
  Json json = manifest_json(run);
  KnownHashes known;
  if (auto list = named_list(run, json)) known = {*std::move(list), fs::last_write_time(run / kArtefactsFile) - kClock};
  const io::FileHashes files = artefacts(run, known);
  if (known.hashes == files) return;
  json.erase(kListHash);
  json.erase("artefacts");  // the list in manifests of earlier versions of the program
  write_json(run, json);
  write_with_list(run, std::move(json), files);
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
  std::vector<std::pair<std::string, std::string>> facts{
      {"command", made_by.command},
      {"version", json.value("version", std::string()) + ", commit " + made_by.commit},
      {"started", made_by.start},
      {"ended", json.value("end", std::string())},
      {"compiler", made_by.compiler},
      {"libraries", made_by.libraries},
      {"processor", made_by.processor},
      {"files", "effective.yaml holds every parameter; artefacts.sha256 the SHA-256 of every file"}};
  std::string modules;
  for (const auto& module : json.value("without_sandbox", std::vector<std::string>{}))
    modules += (modules.empty() ? "" : "; ") + module;
  if (!modules.empty())
    facts.emplace_back("sandbox", "these modules ran with the rights of the user, not in the sandbox: " + modules);
  return facts;
} catch (const Json::exception& e) {
  refuse_json(run / kManifestFile, e);
}

}  // namespace scanbench::runs
