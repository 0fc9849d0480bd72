// Programs behind the interfaces of modules.
#pragma once

#include <memory>

#include "core/modules.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// Starts the program and gives it its parameters. Interface is the one of source.module.kind. The module throws
/// ForeignFault where the program fails, InvalidResult for an answer that is not a result; what is wrong with a result
/// that can be read is the caller's to check, as for any module.
template <class Interface>
std::unique_ptr<Interface> run_program(const ForeignSource& source, const ParamSet& params,
                                       const ForeignSetting& setting);

template <>
std::unique_ptr<LineExtractor> run_program(const ForeignSource&, const ParamSet&, const ForeignSetting&);
template <>
std::unique_ptr<ScanMatcher> run_program(const ForeignSource&, const ParamSet&, const ForeignSetting&);
template <>
std::unique_ptr<Aligner> run_program(const ForeignSource&, const ParamSet&, const ForeignSetting&);
template <>
std::unique_ptr<Mapper> run_program(const ForeignSource&, const ParamSet&, const ForeignSetting&);
template <>
std::unique_ptr<SegmentMerger> run_program(const ForeignSource&, const ParamSet&, const ForeignSetting&);

}  // namespace scanbench::study
