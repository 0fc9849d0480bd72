// Descriptions of foreign modules, from child processes.
#include "harness/foreign/inspect.hpp"

#include <map>
#include <span>
#include <system_error>
#include <variant>

#include <nlohmann/json.hpp>

#include "harness/files/descriptor.hpp"
#include "harness/files/hash.hpp"
#include "harness/files/json.hpp"
#include "harness/foreign/call.hpp"
#include "harness/foreign/confine.hpp"
#include "harness/foreign/fault.hpp"
#include "harness/foreign/hello.hpp"
#include "harness/foreign/library.hpp"
#include "harness/foreign/program.hpp"
#include "harness/process/child.hpp"
#include "harness/process/descendants.hpp"
#include "harness/process/output_tail.hpp"
#include "harness/process/pipe.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kSeconds = 60;                    // for an interpreter to load its libraries
constexpr std::size_t kLongestText = 4U << 20;  // of a description

/// Runs in the child: loads the library and writes what is in it. The result is the exit code.
int describe(const fs::path& library) {
  confine();
  std::string text;
  try {
    nlohmann::json list = nlohmann::json::array();
    for (const ForeignModule& module : load_library(library)) list.push_back(to_hello(module));
    text = json_line(list);
  } catch (const std::exception& error) {
    text = json_line(nlohmann::ordered_json{{"error", error.what()}});
  }
  return write_all(kChannel, std::as_bytes(std::span(text))) ? 0 : 3;
}

std::string described_by_child(const fs::path& library) {
  const std::string name = "the library " + library.filename().string();
  const NothingStays after_this;
  Pipe report;
  Pipe printed;
  Child child;
  try {
    report = make_pipe();
    printed = make_pipe();
    child = start_child({.output = printed.write_end.number(),
                         .errors = printed.write_end.number(),
                         .channel = report.write_end.number(),
                         .own_group = true},
                        [&] { return describe(library); });
  } catch (const std::system_error& error) {
    throw ForeignFault(name + " cannot be inspected: " + error.code().message());
  }
  PipeReader description(std::move(report.read_end), kLongestText);
  PipeReader output(std::move(printed.read_end), kOutputKept);
  const bool in_time = child.wait(kSeconds, {&description, &output});
  if (!in_time) child.kill();
  const ProcessEnd end = child.reap();
  remove_confinement(child.pid());
  const std::string tail = output.bytes().empty() ? "" : "\n" + output_tail(output.bytes());
  if (!in_time) throw ForeignFault(name + " could not be loaded within " + std::to_string(kSeconds) + " s" + tail);
  if (end.signal != 0 || description.bytes().empty())
    throw ForeignFault(name + " ended its process while it was loaded, " + to_text(end) + tail);
  return description.bytes();
}

ForeignModule described_by(const ForeignSource& source, bool sandbox) {
  const NothingStays after_this;
  Program program(source, {.sandbox = sandbox, .writable_folder = {}, .hidden_folder = {}}, ProgramOutput::captured);
  const Call hello = Call("hello").key("scanbench", kProtocolVersion);
  const Answer answer = program.call(hello.header(), {}, kSeconds);
  try {
    return read_hello(answer.header());
  } catch (const ForeignFault& fault) {
    throw ForeignFault("the program `" + source.text() + "` " + fault.what());
  }
}

}  // namespace

void inspect_program(ForeignSource& source, bool sandbox) {
  // A scenario and a suite read a pipeline several times; a program that does not answer takes a minute each time.
  static std::map<std::string, std::variant<ForeignModule, ForeignFault>> known;
  Sha256 hash;
  for (const auto& argument : source.program) hash.part("argument", argument);
  for (const auto& file : source.files) hash.part(file.path.string(), file.sha256);
  const std::string key = hash.hex();
  auto found = known.find(key);
  if (found == known.end()) {
    try {
      found = known.emplace(key, described_by(source, sandbox)).first;
    } catch (const ForeignFault& fault) {
      found = known.emplace(key, fault).first;
    }
  }
  if (const auto* fault = std::get_if<ForeignFault>(&found->second)) throw ForeignFault(*fault);
  source.module = std::get<ForeignModule>(found->second);
}

std::vector<ForeignSource> inspect_library(const fs::path& library) {
  check_stamp(library);
  const nlohmann::json list = parsed_foreign_json(described_by_child(library));
  if (const auto error = list.find("error"); error != list.end())
    throw ForeignFault(error->is_string() ? error->get<std::string>()
                                          : "the library " + library.filename().string() +
                                                " reports an error that is not a text: " + json_line(*error));
  if (!list.is_array() || list.empty())
    throw ForeignFault("the library " + library.filename().string() + " has no module");
  std::vector<ForeignSource> sources;
  for (const auto& hello : list) {
    ForeignSource source;
    source.library = fs::absolute(library).lexically_normal();
    source.files = {{source.library, sha256_of_file(library)}};
    source.module = read_hello(hello);
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace scanbench::harness
