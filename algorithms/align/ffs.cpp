// Force field simulation (FFS): aligns all scans by the forces between their points. Lakaemper, "Augmenting sparse
// laser scans with virtual scans to improve the performance of alignment algorithms", 2010, section 3, after Lakaemper,
// Adluru, Latecki & Madhavan, Journal of Field Robotics 2007. docs/algorithms/ffs.md has the derivations, the
// departures from the text and the results for difficult input.
#include "algorithms/align/ffs/simulation.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

class Ffs final : public Aligner {
 public:
  using Params = align::ffs::Schedule;
  explicit Ffs(const Params& params) : schedule_(params) { schedule_.check(); }

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override {
    return align::ffs::simulate(scans, initial, schedule_, {}, trace);
  }

 private:
  align::ffs::Schedule schedule_;
};

SCANBENCH_REGISTER(
    Aligner, Ffs,
    {.name = "ffs",
     .summary = "force field simulation: scans as rigid bodies drawn together by soft point correspondences",
     .reference = "Lakaemper 2010, section 3; Lakaemper, Adluru, Latecki & Madhavan 2007"});

}  // namespace
}  // namespace scanbench
