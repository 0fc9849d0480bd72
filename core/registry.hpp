// Registries of named modules. A file that defines a module registers it with one line:
//
//   SCANBENCH_REGISTER(LineExtractor, Iepf, {.name = "iepf", .summary = "...", .reference = "..."});
//
// Impl has a nested `Params` (core/params.hpp) and a constructor from it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/names.hpp"
#include "core/params.hpp"

namespace scanbench {

struct ModuleInfo {
  std::string name;
  std::string summary;    ///< one line
  std::string reference;  ///< paper and section
};

template <class Interface>
class Registry {
 public:
  struct Entry {
    ModuleInfo info;
    std::vector<ParamSpec> params;
    std::function<std::unique_ptr<Interface>(const ParamSet&)> make;
  };

  /// Returns true, so that SCANBENCH_REGISTER can initialise a constant with it. Throws InternalError for a name that
  /// is already registered.
  template <class Impl>
  static bool add(ModuleInfo info) {
    using Params = typename Impl::Params;
    const std::string name = info.name;
    const bool is_new = entries()
                            .emplace(name, Entry{std::move(info), param_specs<Params>(),
                                                 [](const ParamSet& set) -> std::unique_ptr<Interface> {
                                                   return std::make_unique<Impl>(make_params<Params>(set));
                                                 }})
                            .second;
    if (!is_new) throw InternalError("the name '" + name + "' is registered twice");
    return true;
  }

  /// All entries by name, in alphabetical order, independent of the order of linking.
  static const std::map<std::string, Entry, std::less<>>& all() { return entries(); }

  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const auto& [name, entry] : entries()) result.push_back(name);
    return result;
  }

  /// The entry; nullptr for an unknown name.
  static const Entry* find(std::string_view name) {
    const auto it = entries().find(name);
    return it == entries().end() ? nullptr : &it->second;
  }

  /// A module with its parameters; throws ConfigError for an unknown name, ParamError for a bad parameter.
  static std::unique_ptr<Interface> make(std::string_view name, const ParamSet& params = {}) {
    const Entry* entry = find(name);
    if (entry == nullptr) {
      throw ConfigError("unknown " + std::string(Interface::kKind) + " '" + std::string(name) +
                        "'; known: " + join(names()));
    }
    return entry->make(params);
  }

 private:
  static std::map<std::string, Entry, std::less<>>& entries() {
    static std::map<std::string, Entry, std::less<>> map;
    return map;
  }
};

}  // namespace scanbench

#define SCANBENCH_REGISTER_JOIN(name, number) name##number
#define SCANBENCH_REGISTER_NAME(number) SCANBENCH_REGISTER_JOIN(registered_, number)

/// Registers Impl as a module of the interface before main() begins; the third argument is its ModuleInfo. Each use
/// defines a constant with a name of its own, so that several files can be compiled as one.
#define SCANBENCH_REGISTER(Interface, Impl, ...)                     \
  [[maybe_unused]] const bool SCANBENCH_REGISTER_NAME(__COUNTER__) = \
      scanbench::Registry<Interface>::add<Impl>(__VA_ARGS__)
