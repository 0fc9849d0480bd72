// Counts the cells of a sweep that are committed.
#include "harness/runs/sweep/sweep_status.hpp"

#include <set>
#include <string_view>
#include <unordered_map>

#include "harness/runs/sweep/shard_commit.hpp"

namespace scanbench::runs {

SweepStatus sweep_status(const SweepPlan& plan) {
  ShardCommits commits = load_commits(plan.folder);
  std::unordered_map<std::string_view, bool> is_ok;  // by address
  for (const ShardCommit& commit : commits.whole)
    for (const ArchivedCell& cell : commit.table.cells)
      is_ok[cell.record.address] |= cell.record.outcome.status == CellStatus::ok;
  SweepStatus status;
  std::set<int> shards;
  for (const SweepCell& cell : plan.cells) {
    const auto found = is_ok.find(cell.address);
    ++(found == is_ok.end() ? status.missing : found->second ? status.ok : status.failed);
    if (found != is_ok.end()) continue;
    if (cell.shard == 0)
      ++status.lost;
    else
      shards.insert(cell.shard);
  }
  status.cells = plan.cells.size();
  status.missing_shards.assign(shards.begin(), shards.end());
  status.damaged = std::move(commits.damaged);
  status.unfinished = commits.unfinished;
  return status;
}

std::string array_text(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ",";
    text += std::to_string(numbers[i]);
    if (last > i) text += "-" + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace scanbench::runs
