// Shared by the tests of runs: temporary folders, recordings without a simulator, and small modules that behave or
// misbehave (registered in runs.cpp under names that begin with "test_").
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/execute/runner.hpp"
#include "tests/support/temporary_folder.hpp"

namespace scanbench::fixtures {

/// Random scans with every kind of reading (+inf, -inf, NaN, -0.0), random poses, and random truth unless it is a log.
Recording random_recording(std::uint64_t seed, int frames, int beams, bool with_truth);

/// Values of doubles as their bits: equal only if no bit was lost, NaN included.
std::vector<std::uint64_t> bits(const std::vector<double>& values);

/// A pipeline of one slot.
study::PipelineSpec extract_with(const std::string& name, const std::string& module, const ParamSet& params = {});

/// A scenario whose recordings are random_recording(seed, 5, 16, true), scored with test_metrics.
study::Scenario scenario_with(const std::string& name, std::vector<study::PipelineSpec> pipelines,
                              std::vector<std::uint64_t> seeds = {1});
runs::RunServices services();
runs::RunResult run_here(const std::vector<study::Scenario>& scenarios, const runs::RunOptions& options);

/// Every file below a run with its bytes: without the manifest and timing.csv, and status.json without its times.
std::map<std::string, std::string> artefacts(const std::filesystem::path& run);

/// The status of a cell, by "scenario/pipeline/seed"; throws if the run has no such cell.
const runs::CellResult& cell_of(const runs::RunResult& result, const std::string& key);

/// Files and folders below a folder, temporary ones included.
std::vector<std::string> listing(const std::filesystem::path& folder);

}  // namespace scanbench::fixtures
