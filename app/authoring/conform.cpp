// The verb conform: runs the conformance checks on the modules of a library or on a program.
#include "app/authoring/conform.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/foreign.hpp"
#include "app/terminal/progress.hpp"
#include "core/error.hpp"
#include "core/modules.hpp"
#include "harness/catalog/make_module.hpp"
#include "harness/conform/aligner_checks.hpp"
#include "harness/conform/check.hpp"
#include "harness/conform/description_checks.hpp"
#include "harness/conform/extractor_checks.hpp"
#include "harness/conform/mapper_checks.hpp"
#include "harness/conform/matcher_checks.hpp"
#include "harness/conform/merger_checks.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/run/worker.hpp"

namespace scanbench::app {
namespace {

constexpr harness::WorkerLimits kCheckLimits{.seconds = 60.0, .memory_bytes = 2e9, .threads = 1};

/// What went wrong in a check, run in a child process; empty if nothing did.
std::string faults_of(const std::function<void(conform::Findings&)>& check) {
  harness::WorkerPool pool;
  pool.start(
      0,
      [&] {
        conform::Findings findings;
        check(findings);
        std::string text;
        for (const auto& fault : findings.faults()) text += (text.empty() ? "" : "; ") + fault;
        return text;
      },
      kCheckLimits);
  const auto finished = pool.wait();
  if (finished.empty()) throw ConfigError("interrupted");
  const harness::WorkerOutcome& outcome = finished.front().outcome;
  if (outcome.status == harness::CellStatus::ok) return outcome.message;
  return std::string(to_string(outcome.status)) + ": " + outcome.message;
}

/// Runs and prints one check. True if it is passed.
bool passes(const std::string& name, const std::function<void(conform::Findings&)>& check) {
  const std::string faults = faults_of(check);
  fmt::print("  {}  {}\n", faults.empty() ? "ok  " : "FAIL", name);
  if (!faults.empty()) fmt::print("        {}\n", harness::plain_line(faults));
  return faults.empty();
}

template <class Interface>
int count_failures(const harness::ModuleChoice& choice, const std::vector<conform::Check<Interface>>& checks) {
  const conform::Subject<Interface> subject{choice.source->module.params, [&](const ParamSet& params) {
                                              harness::ModuleChoice made = choice;
                                              made.params = resolve(choice.source->module.params, params);
                                              return harness::make_module<Interface>(made, {});
                                            }};
  int failures = 0;
  for (const auto& check : checks)
    failures += passes(check.name, [&](conform::Findings& findings) { check.run(subject, findings); }) ? 0 : 1;
  return failures;
}

/// How many checks the module fails.
int check_module(const harness::ForeignSource& source) {
  const harness::ForeignModule& module = source.module;
  const harness::ModuleChoice choice{module.kind, module.info.name, {}, source};
  fmt::print("{} ({}, from {})\n", module.info.name, module.kind, source.text());
  int failures =
      passes("ItIsDocumented",
             [&](conform::Findings& findings) { conform::check_description(module.info, module.params, findings); })
          ? 0
          : 1;
  if (module.kind == LineExtractor::kKind) failures += count_failures(choice, conform::extractor_checks());
  if (module.kind == ScanMatcher::kKind) failures += count_failures(choice, conform::matcher_checks());
  if (module.kind == Aligner::kKind) failures += count_failures(choice, conform::aligner_checks());
  if (module.kind == Mapper::kKind) failures += count_failures(choice, conform::mapper_checks());
  if (module.kind == SegmentMerger::kKind) failures += count_failures(choice, conform::merger_checks());
  return failures;
}

int conform_verb(const ForeignOptions& options) {
  const auto sources = foreign_sources(options);
  if (sources.empty()) throw ConfigError("conform needs --plugin FILE or --program WORD...");
  int failures = 0;
  for (const auto& source : sources) failures += check_module(source);
  if (failures > 0) fmt::print("{} failed\n", counted(static_cast<std::size_t>(failures), "check"));
  return failures == 0 ? kGood : kGateFailed;
}

}  // namespace

void add_conform(CommandLine& line) {
  auto options = std::make_shared<ForeignOptions>();
  Verb verb = line.add_verb(
      "conform",
      "Checks the modules of a shared library, or a program, as the tests check the modules of this program");
  add_foreign_options(verb, *options, true);
  verb.runs([options] { return conform_verb(*options); });
}

}  // namespace scanbench::app
