// Selects the registry of a kind of module.
#include "harness/study/catalog/find_module.hpp"

#include "core/error.hpp"
#include "core/modules.hpp"
#include "core/names.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/study/catalog/chain.hpp"
#include "metrics/metric.hpp"
#include "render/figure.hpp"
#include "sim/trajectory.hpp"

namespace scanbench::study {
namespace {

template <class Interface>
struct Kind {
  using type = Interface;
};

template <class Use>
auto with_kind(std::string_view kind, const Use& use) {
  if (kind == LineExtractor::kKind) return use(Kind<LineExtractor>{});
  if (kind == Aligner::kKind) return use(Kind<Aligner>{});
  if (kind == ScanMatcher::kKind) return use(Kind<ScanMatcher>{});
  if (kind == Mapper::kKind) return use(Kind<Mapper>{});
  if (kind == SegmentMerger::kKind) return use(Kind<SegmentMerger>{});
  if (kind == metrics::MetricFamily::kKind) return use(Kind<metrics::MetricFamily>{});
  if (kind == render::Figure::kKind) return use(Kind<render::Figure>{});
  if (kind == sim::TrajectoryKind::kKind) return use(Kind<sim::TrajectoryKind>{});
  throw ConfigError("no kind of module is called " + io::quoted_excerpt(kind) + known_names(kind, module_kinds()));
}

/// "extract" -> "line extractor": what a reader calls a module of this kind.
std::string noun_of(std::string_view kind) {
  if (kind == LineExtractor::kKind) return "line extractor";
  if (kind == Aligner::kKind) return "aligner";
  if (kind == ScanMatcher::kKind) return "scan matcher";
  if (kind == Mapper::kKind) return "mapper";
  if (kind == SegmentMerger::kKind) return "segment merger";
  if (kind == metrics::MetricFamily::kKind) return "metric family";
  return std::string(kind);
}

}  // namespace

const std::vector<std::string>& module_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> all;
    for (const SlotKind& slot : chain_slots()) all.emplace_back(slot.kind);
    for (const std::string_view other :
         {metrics::MetricFamily::kKind, render::Figure::kKind, sim::TrajectoryKind::kKind})
      all.emplace_back(other);
    return all;
  }();
  return kinds;
}

std::vector<std::string> module_names(std::string_view kind) {
  return with_kind(kind, [](auto tag) { return Registry<typename decltype(tag)::type>::names(); });
}

ModuleEntry find_module(std::string_view kind, std::string_view name) {
  return with_kind(kind, [&](auto tag) -> ModuleEntry {
    const auto* entry = Registry<typename decltype(tag)::type>::find(name);
    if (entry == nullptr)
      throw ConfigError("no " + noun_of(kind) + " is called " + io::quoted_excerpt(name) +
                        known_names(name, module_names(kind)));
    return {entry->info, entry->params};
  });
}

ModuleEntry entry_of(const ModuleChoice& choice) {
  if (choice.source) return {choice.source->module.info, choice.source->module.params};
  return find_module(choice.kind, choice.module);
}

void try_module(std::string_view kind, std::string_view name, const ParamSet& params) {
  with_kind(kind, [&](auto tag) { Registry<typename decltype(tag)::type>::make(name, params); });
}

}  // namespace scanbench::study
