// Hashes the effective scenario, so that every field of a scenario enters the address of its cells.
#include "harness/runs/execute/cell_address.hpp"

#include <filesystem>
#include <variant>
#include <vector>

#include "harness/io/files/hash.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/foreign_slot.hpp"

namespace scanbench::runs {
namespace {

/// SHA-256 of the files of an input.
using Hashes = std::vector<std::string>;

/// Removes the paths of files from an input and returns the hashes of the files. Their bytes enter the address, not
/// their paths.
Hashes take_files(study::SimulatedInput& input) {
  input.caster = sim::CasterKind::exact;  // both casters give the same bytes
  return {};                              // the world itself is part of the text
}

/// Replaces the path of a file, if there is one, by the root. `known`: its hash, empty if it must be computed.
void take(std::filesystem::path& path, std::string& as_written, const std::string& known, Hashes& taken) {
  if (!path.empty()) {
    taken.push_back(known.empty() ? io::sha256_of_file(path) : known);
    path = "/";
  }
  as_written.clear();
}

Hashes take_files(study::RecordedInput& input) {
  Hashes taken;
  take(input.log, input.log_as_written, input.log_sha256, taken);
  take(input.relations, input.relations_as_written, input.relations_sha256, taken);
  return taken;
}

Hashes take_files(study::LinesInput& input) {
  Hashes taken;
  take(input.file, input.file_as_written, "", taken);
  return taken;
}

}  // namespace

std::string input_address(const study::Scenario& scenario) {
  study::Scenario part;
  part.input = scenario.input;
  const Hashes files = std::visit([](auto& input) { return take_files(input); }, part.input);
  io::Sha256 hash;
  hash.part("input", study::effective_yaml(part));
  for (const auto& file : files) hash.part("file", file);
  return hash.hex();
}

std::string work_address(const std::vector<study::ModuleChoice>& metrics, const study::PipelineSpec& pipeline) {
  study::Scenario part;
  part.input = study::LinesInput{};  // no input here: it has its own address
  part.pipelines.push_back({.name = "", .slots = pipeline.slots, .published = ""});
  for (study::ModuleChoice& slot : part.pipelines.back().slots)
    if (slot.source) slot.source = study::without_folders(std::move(*slot.source));
  part.metrics = metrics;
  return io::sha256_hex(study::effective_yaml(part));
}

std::string cell_address(const std::string& input, const std::string& work, std::uint64_t seed,
                         const study::TraceChoice& trace) {
  return io::Sha256()
      .part("schema", "3")
      .part("code", code_version())
      .part("input", input)
      .part("seed", std::to_string(seed))
      .part("work", work)
      .part("trace", trace.text())
      .hex();
}

}  // namespace scanbench::runs
