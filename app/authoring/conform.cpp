// The verb `module conform`: runs the conformance checks on the modules of a library or on a program.
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
#include "harness/results/document/plain_text.hpp"
#include "harness/runs/execute/worker.hpp"
#include "harness/study/catalog/make_module.hpp"
#include "harness/study/conform/aligner_checks.hpp"
#include "harness/study/conform/check.hpp"
#include "harness/study/conform/description_checks.hpp"
#include "harness/study/conform/extractor_checks.hpp"
#include "harness/study/conform/mapper_checks.hpp"
#include "harness/study/conform/matcher_checks.hpp"
#include "harness/study/conform/merger_checks.hpp"

namespace scanbench::app {
namespace {

constexpr runs::WorkerLimits kCheckLimits{.seconds = 60.0, .memory_bytes = 2e9, .threads = 1};

/// What went wrong in a check, run in a child process; empty if nothing did.
std::string faults_of(const std::function<void(study::conform::Findings&)>& check) {
  runs::WorkerPool pool;
  pool.start(
      0,
      [&] {
        study::conform::Findings findings;
        check(findings);
        std::string text;
        for (const auto& fault : findings.faults()) text += (text.empty() ? "" : "; ") + fault;
        return text;
      },
      kCheckLimits);
  const auto finished = pool.wait();
  if (finished.empty()) throw ConfigError("interrupted");
  const runs::WorkerOutcome& outcome = finished.front().outcome;
  if (outcome.status == runs::CellStatus::ok) return outcome.message;
  return std::string(to_string(outcome.status)) + ": " + outcome.message;
}

/// Runs and prints one check. True if it is passed.
bool passes(const std::string& name, const std::function<void(study::conform::Findings&)>& check) {
  const std::string faults = faults_of(check);
  fmt::print("  {}  {}\n", faults.empty() ? "ok  " : "FAIL", name);
  if (!faults.empty()) fmt::print("        {}\n", results::plain_line(faults));
  return faults.empty();
}

template <class Interface>
int count_failures(const study::ModuleChoice& choice, const std::vector<study::conform::Check<Interface>>& checks) {
  const study::conform::Subject<Interface> subject{choice.source->module.params, [&](const ParamSet& params) {
                                                     study::ModuleChoice made = choice;
                                                     made.params = resolve(choice.source->module.params, params);
                                                     return study::make_module<Interface>(made, {});
                                                   }};
  int failures = 0;
  for (const auto& check : checks)
    failures += passes(check.name, [&](study::conform::Findings& findings) { check.run(subject, findings); }) ? 0 : 1;
  return failures;
}

/// How many checks the module fails.
int check_module(const study::ForeignSource& source) {
  const study::ForeignModule& module = source.module;
  const study::ModuleChoice choice{module.kind, module.info.name, {}, source};
  fmt::print("{} ({}, from {})\n", module.info.name, module.kind, source.text());
  int failures = passes("ItIsDocumented",
                        [&](study::conform::Findings& findings) {
                          study::conform::check_description(module.info, module.params, findings);
                        })
                     ? 0
                     : 1;
  if (module.kind == LineExtractor::kKind) failures += count_failures(choice, study::conform::extractor_checks());
  if (module.kind == ScanMatcher::kKind) failures += count_failures(choice, study::conform::matcher_checks());
  if (module.kind == Aligner::kKind) failures += count_failures(choice, study::conform::aligner_checks());
  if (module.kind == Mapper::kKind) failures += count_failures(choice, study::conform::mapper_checks());
  if (module.kind == SegmentMerger::kKind) failures += count_failures(choice, study::conform::merger_checks());
  return failures;
}

int conform_verb(const ForeignOptions& options) {
  const auto sources = foreign_sources(options);
  if (sources.empty()) throw ConfigError("module conform needs --plugin FILE or --program WORD...");
  int failures = 0;
  for (const auto& source : sources) failures += check_module(source);
  if (failures > 0) fmt::print("{} failed\n", counted(static_cast<std::size_t>(failures), "check"));
  return failures == 0 ? kGood : kGateFailed;
}

}  // namespace

void add_conform(Verb& module) {
  auto options = std::make_shared<ForeignOptions>();
  Verb verb = module.add_verb(
      "conform",
      "Checks the modules of a shared library, or a program, as the tests check the modules of this program");
  add_foreign_options(verb, *options, true);
  verb.runs([options] { return conform_verb(*options); });
}

}  // namespace scanbench::app
