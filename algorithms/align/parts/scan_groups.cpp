// Union of scans that meet, and the common motion that an alignment does not determine.
#include "algorithms/align/parts/scan_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanbench::align {
namespace {

constexpr std::size_t kListedScans = 5;
constexpr std::size_t kNamedGroups = 8;
constexpr double kFarthestOriginM = 1e9;

std::string named(const std::vector<std::size_t>& group) {
  if (group.size() > kListedScans) return std::to_string(group.size()) + " scans";
  std::string text = group.size() == 1 ? "scan " : "scans ";
  for (std::size_t k = 0; k < group.size(); ++k) text += (k > 0 ? ", " : "") + std::to_string(group[k]);
  return text;
}

}  // namespace

ScanGroups::ScanGroups(std::size_t scans) : parent_(scans) {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
}

std::size_t ScanGroups::root(std::size_t scan) const {
  while (parent_[scan] != scan) scan = parent_[scan];
  return scan;
}

void ScanGroups::join(std::size_t a, std::size_t b) {
  const std::size_t low = std::min(root(a), root(b)), high = std::max(root(a), root(b));
  parent_[high] = low;
  parent_[a] = parent_[b] = low;
}

std::vector<std::vector<std::size_t>> ScanGroups::groups() const {
  std::vector<std::vector<std::size_t>> of_root(parent_.size());
  for (std::size_t k = 0; k < parent_.size(); ++k) of_root[root(k)].push_back(k);
  std::erase_if(of_root, [](const auto& group) { return group.empty(); });
  std::stable_sort(of_root.begin(), of_root.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return of_root;
}

std::string ScanGroups::complaint() const {
  const auto all = groups();
  if (all.size() <= 1) return "";
  std::string text = std::to_string(all.size()) + " groups of scans do not meet: ";
  for (std::size_t g = 0; g < std::min(all.size(), kNamedGroups); ++g) text += (g > 0 ? "; " : "") + named(all[g]);
  return text + (all.size() > kNamedGroups ? "; ..." : "");
}

std::vector<Pose2> held_at_first(std::span<const Pose2> initial, std::span<const Pose2> poses) {
  std::vector<Pose2> result(poses.begin(), poses.end());
  if (poses.empty()) return result;
  const Pose2 back = initial.front() * poses.front().inverse();
  for (Pose2& pose : result) pose = back * pose;
  result.front() = initial.front();
  return result;
}

std::string unusable_pose(std::span<const Pose2> poses) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Pose2& p = poses[k];
    const bool turns = std::isfinite(p.cos()) && std::isfinite(p.sin());
    if (!turns || !p.translation().allFinite() || p.translation().cwiseAbs().maxCoeff() > kFarthestOriginM)
      return "the given pose of scan " + std::to_string(k) + " is not finite or beyond 1e9 m";
  }
  return "";
}

}  // namespace scanbench::align
