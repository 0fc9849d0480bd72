// Checks and loads shared libraries of modules.
#include "harness/study/foreign/library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "core/modules.hpp"
#include "core/plugin_stamp.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/study/foreign/arithmetic.hpp"
#include "harness/study/foreign/fault.hpp"

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;

/// "a=1; b=2" as a map.
std::map<std::string, std::string> entries_of(std::string_view stamp) {
  std::map<std::string, std::string> entries;
  while (!stamp.empty()) {
    const std::string_view entry = stamp.substr(0, stamp.find("; "));
    const std::size_t equals = std::min(entry.find('='), entry.size() - 1);
    entries[std::string(entry.substr(0, equals))] = entry.substr(equals + 1);
    stamp.remove_prefix(std::min(stamp.size(), entry.size() + 2));
  }
  return entries;
}

/// The text between the marks of a stamp; empty if there is none.
std::string_view stamp_in(std::string_view bytes) {
  const std::string_view begin = SCANBENCH_STAMP_BEGIN, end = SCANBENCH_STAMP_END;
  const std::size_t at = bytes.find(begin);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = bytes.substr(at + begin.size(), 1000);
  return rest.substr(0, rest.find(end));
}

template <class Interface>
void append_names(std::set<std::string>& names) {
  for (const std::string& name : Registry<Interface>::names()) names.insert(std::string(Interface::kKind) + "/" + name);
}

std::set<std::string> registered_names() {
  std::set<std::string> names;
  append_names<LineExtractor>(names);
  append_names<ScanMatcher>(names);
  append_names<Aligner>(names);
  append_names<Mapper>(names);
  append_names<SegmentMerger>(names);
  return names;
}

template <class Interface>
void append_new(const std::set<std::string>& before, std::vector<ForeignModule>& modules) {
  for (const auto& [name, entry] : Registry<Interface>::all())
    if (!before.contains(std::string(Interface::kKind) + "/" + name))
      modules.push_back({std::string(Interface::kKind), entry.info, "", entry.params});
}

std::string named(const fs::path& library) {
  return "the library " + library.filename().string();
}

}  // namespace

void check_stamp(const fs::path& library) {
  const std::string bytes = io::read_file(library);
  const std::string_view found = stamp_in(bytes);
  if (!bytes.starts_with("\177ELF")) throw ForeignFault(named(library) + " is not a shared library");
  if (found.empty())
    throw ForeignFault(named(library) +
                       " has no stamp; build it with the function scanbench_plugin() of find_package(scanbench)");
  auto ours = entries_of(stamp_in(SCANBENCH_PLUGIN_STAMP));
  std::string differences;
  for (const auto& [key, value] : entries_of(found))
    if (ours[key] != value)
      differences += (differences.empty() ? "" : ", ") + key + " " + value + " instead of " + ours[key];
  if (!differences.empty())
    throw ForeignFault(named(library) + " was built for another scanbench or by another compiler (" + differences +
                       "); build it again");
}

std::vector<ForeignModule> load_library(const fs::path& library) {
  check_stamp(library);
  const std::set<std::string> before = registered_names();
  const Arithmetic arithmetic;
  if (::dlopen(fs::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr)
    throw ForeignFault(named(library) + " cannot be loaded: " + ::dlerror());
  if (arithmetic.restore())
    throw ForeignFault(named(library) +
                       " changes the floating-point arithmetic of the process, as libraries do that are linked with "
                       "-ffast-math; link it without");
  std::vector<ForeignModule> modules;
  append_new<LineExtractor>(before, modules);
  append_new<ScanMatcher>(before, modules);
  append_new<Aligner>(before, modules);
  append_new<Mapper>(before, modules);
  append_new<SegmentMerger>(before, modules);
  return modules;
}

}  // namespace scanbench::study
