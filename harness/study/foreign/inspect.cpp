// Descriptions of foreign modules, from child processes.
#include "harness/study/foreign/inspect.hpp"

#include <map>
#include <span>
#include <system_error>
#include <variant>

#include <nlohmann/json.hpp>

#include "harness/io/files/descriptor.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/process/child.hpp"
#include "harness/io/process/descendants.hpp"
#include "harness/io/process/output_tail.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/study/foreign/call.hpp"
#include "harness/study/foreign/confine.hpp"
#include "harness/study/foreign/fault.hpp"
#include "harness/study/foreign/hello.hpp"
#include "harness/study/foreign/library.hpp"
#include "harness/study/foreign/program.hpp"

namespace scanbench::study {
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
    text = io::json_line(list);
  } catch (const std::exception& error) {
    text = io::json_line(nlohmann::ordered_json{{"error", error.what()}});
  }
  return io::write_all(io::kChannel, std::as_bytes(std::span(text))) ? 0 : 3;
}

std::string described_by_child(const fs::path& library) {
  const std::string name = "the library " + library.filename().string();
  const io::NothingStays after_this;
  io::Pipe report;
  io::Pipe printed;
  io::Child child;
  try {
    report = io::make_pipe();
    printed = io::make_pipe();
    child = io::start_child({.output = printed.write_end.number(),
                             .errors = printed.write_end.number(),
                             .channel = report.write_end.number(),
                             .own_group = true},
                            [&] { return describe(library); });
  } catch (const std::system_error& error) {
    throw ForeignFault(name + " cannot be inspected: " + error.code().message());
  }
  io::PipeReader description(std::move(report.read_end), kLongestText);
  io::PipeReader output(std::move(printed.read_end), io::kOutputKept);
  const bool in_time = child.wait(kSeconds, {&description, &output});
  if (!in_time) child.kill();
  const io::ProcessEnd end = child.reap();
  remove_confinement(child.pid());
  const std::string tail = output.bytes().empty() ? "" : "\n" + io::output_tail(output.bytes());
  if (!in_time) throw ForeignFault(name + " could not be loaded within " + std::to_string(kSeconds) + " s" + tail);
  if (end.signal != 0 || description.bytes().empty())
    throw ForeignFault(name + " ended its process while it was loaded, " + io::to_text(end) + tail);
  return description.bytes();
}

ForeignModule described_by(const ForeignSource& source, bool sandbox) {
  const io::NothingStays after_this;
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
  io::Sha256 hash;
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
                                                " reports an error that is not a text: " + io::json_line(*error));
  if (!list.is_array() || list.empty())
    throw ForeignFault("the library " + library.filename().string() + " has no module");
  std::vector<ForeignSource> sources;
  for (const auto& hello : list) {
    ForeignSource source;
    source.library = fs::absolute(library).lexically_normal();
    source.files = {{source.library, io::sha256_of_file(library)}};
    source.module = read_hello(hello);
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace scanbench::study
