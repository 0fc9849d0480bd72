// Selects the comparable values of a scenario: those of seeds that every pipeline finished, with notes on missing ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// A cell as the report lists it.
struct CellLine {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  std::string status;   ///< a name of CellStatus, or "missing"
  std::string message;  ///< why it failed; of a cell that is ok, the remarks of its pipeline
  double wall_seconds = 0.0;
  double peak_memory_bytes = 0.0;
  bool selected = true;  ///< false: the run was restricted to other cells, and this one does not exist
  std::string folder{};  ///< of its files, relative to the run: "cells/room/iepf/1/"; empty: it has none of its own
};

/// Numbers of cells of one pipeline by status.
struct Coverage {
  std::size_t ok = 0;
  std::size_t all = 0;
  std::map<std::string, std::size_t> others;  ///< cells by their status, without those that are ok
  std::size_t unconverged = 0;                ///< ok, but an aligner has not converged
  std::size_t no_match_scans = 0;             ///< of cells that are ok: a matcher or mapper has no match for them
  std::size_t unconverged_scans = 0;          ///< the same, where its pose still moved

  bool complete() const { return ok == all; }
  /// The status of most of the cells that are not ok; empty if all are.
  std::string status() const;
  /// "2 of 6 ok, 4 crashed; not converged in 1 of 6 cells; no match on 3 scans; not converged on 12 scans"; empty if
  /// all cells are ok and nothing of this happened. An open motion is an answer, and is not named.
  std::string text() const;
};

struct ComparableRows {
  std::vector<std::string> pipelines;  ///< that were selected, in the scenario's order
  std::vector<std::uint64_t> seeds;    ///< that every pipeline with a finished cell has finished
  std::vector<runs::SummaryRow> rows;  ///< of these seeds and pipelines
  std::map<std::string, Coverage> coverage;
  std::vector<std::string> notes;  ///< for captions: which seeds the means cover
  struct LineNote {
    std::vector<std::string> metrics;
    std::string text;
  };
  std::vector<LineNote> line_notes;  ///< for captions of tables with these metrics: which lines their means cover
};

/// Restricts the rows of a scenario to the seeds that all pipelines have finished, so that means are over the same
/// input. If no seed is left, every pipeline keeps the seeds that it has, and a note says so. A row "mean" (over walls)
/// is computed again from the walls on which every pipeline has a value, for the same reason. `cells` has the status of
/// every cell; if it has none of the scenario, a cell with rows is ok.
ComparableRows comparable_rows(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows,
                               const std::vector<CellLine>& cells = {});

/// The scenario restricted to the pipelines and seeds of the rows.
study::Scenario restricted(study::Scenario scenario, const ComparableRows& results);

}  // namespace scanbench::results
