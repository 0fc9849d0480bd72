// Hashes the effective scenario, so that every field of a scenario enters the address of its cells.
#include "harness/run/cell_address.hpp"

#include <variant>

#include "harness/files/hash.hpp"
#include "harness/scenario/effective.hpp"

namespace scanbench::harness {
namespace {

/// Removes the path of a file from an input and returns the hash of the file (empty if none). The file's bytes enter
/// the address, not its path.
std::string take_file(SimulatedInput& input) {
  input.caster = sim::CasterKind::exact;  // both casters give the same bytes
  return {};                              // the world itself is part of the text
}

std::string take_file(RecordedInput& input) {
  const std::string hash = input.log_sha256.empty() ? sha256_of_file(input.log) : input.log_sha256;
  input.log = "/";
  input.log_as_written.clear();
  return hash;
}

std::string take_file(LinesInput& input) {
  const std::string hash = input.file.empty() ? "" : sha256_of_file(input.file);
  if (!input.file.empty()) input.file = "/";
  input.file_as_written.clear();
  return hash;
}

}  // namespace

std::string input_address(const Scenario& scenario) {
  Scenario part;
  part.input = scenario.input;
  const std::string file = std::visit([](auto& input) { return take_file(input); }, part.input);
  Sha256 hash;
  hash.part("input", effective_yaml(part));
  if (!file.empty()) hash.part("file", file);
  return hash.hex();
}

std::string cell_address(const std::string& input, const std::vector<ModuleChoice>& metrics,
                         const PipelineSpec& pipeline, std::uint64_t seed, const TraceChoice& trace) {
  Scenario part;
  part.input = LinesInput{};  // no input here: it has its own address
  part.pipelines.push_back({.name = "", .slots = pipeline.slots, .published = ""});
  part.metrics = metrics;
  return Sha256()
      .part("schema", "2")
      .part("code", code_version())
      .part("input", input)
      .part("seed", std::to_string(seed))
      .part("work", effective_yaml(part))
      .part("trace", trace.text())
      .hex();
}

}  // namespace scanbench::harness
