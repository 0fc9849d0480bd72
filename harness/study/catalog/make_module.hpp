// Makes the modules of pipelines, of this program and of others.
#pragma once

#include <memory>

#include "core/registry.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "harness/study/foreign/confine.hpp"
#include "harness/study/foreign/library.hpp"
#include "harness/study/foreign/program_modules.hpp"

namespace scanbench::study {

/// Makes a chosen module. A program is started, a library is loaded into this process, which must be a child: neither
/// is trusted. Throws ConfigError, ParamError, ForeignFault.
template <class Interface>
std::unique_ptr<Interface> make_module(const ModuleChoice& choice, const ForeignSetting& setting) {
  if (choice.source) {
    confine();
    if (!choice.source->program.empty()) return run_program<Interface>(*choice.source, choice.params, setting);
    if (setting.sandbox) leave_network();  // where the system allows it: the manifest says
    load_library(choice.source->library);
  }
  return Registry<Interface>::make(choice.module, choice.params);
}

}  // namespace scanbench::study
