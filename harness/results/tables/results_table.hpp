// Makes the tables of a report from the values of a scenario's cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results/document/table.hpp"
#include "harness/results/tables/comparable_rows.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// One table per metric family of the scenario, without the metrics that are `shown_elsewhere`. Families with many
/// subjects (walls) have a row per subject and a column per pipeline; the others a row per pipeline and a column per
/// metric. Over several seeds a value is the mean with the half width of its 95 % interval.
///
/// The best value of a metric is marked. A pipeline with a missing cell or value is never marked. If the family, or
/// else the scenario, has a metric of completeness (f1, covered_5cm, placed, missed), errors and costs are marked only
/// for pipelines within 0.05 of its best value, because a pipeline that finds little also has small errors.
std::vector<Table> result_tables(const study::Scenario& scenario, const ComparableRows& results,
                                 const std::vector<std::string>& shown_elsewhere = {});

/// The most important values of a scenario, from all its families: a row per pipeline. Marks follow
/// the rules of result_tables(). Nothing if the scenario has none of these metrics.
std::optional<Table> overview_table(const study::Scenario& scenario, const ComparableRows& results);

/// The first answer of an overview in a sentence: "Best F1 of 3 pipelines: sef (0.811)." or why no pipeline is called
/// best. Distances of points from their lines, numbers of lines and times do not judge a pipeline. Of a single
/// pipeline, what it found: "mine found: segments per scan 12.3; total time 0.05 ms."
std::string overview_sentence(const Table& overview);

/// The pipelines that have or share the best value of the first column that judges them; empty if none has.
std::vector<std::string> best_pipelines(const Table& overview);

/// Which pipelines err no less between consecutive scans than the odometry, in a sentence; empty without such errors.
/// Pipelines whose poses are the odometry do not count.
std::string odometry_sentence(const ComparableRows& results);

}  // namespace scanbench::results
