// Descriptions of foreign modules, from child processes.
#include "harness/foreign/inspect.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <variant>

#include <nlohmann/json.hpp>

#include "harness/files/hash.hpp"
#include "harness/files/json.hpp"
#include "harness/foreign/call.hpp"
#include "harness/foreign/confine.hpp"
#include "harness/foreign/fault.hpp"
#include "harness/foreign/hello.hpp"
#include "harness/foreign/library.hpp"
#include "harness/foreign/output_tail.hpp"
#include "harness/foreign/program.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kSeconds = 60;                    // for an interpreter to load its libraries
constexpr std::size_t kLongestText = 4U << 20;  // of a description

/// Runs in the child: loads the library and writes what is in it.
[[noreturn]] void tell(const fs::path& library, pid_t parent, int to, int printed) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) _exit(3);
  ::setpgid(0, 0);
  confine();
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(printed, STDOUT_FILENO);
  ::dup2(printed, STDERR_FILENO);
  std::string text;
  try {
    nlohmann::json list = nlohmann::json::array();
    for (const ForeignModule& module : load_library(library)) list.push_back(to_hello(module));
    text = json_line(list);
  } catch (const std::exception& error) {
    text = json_line(nlohmann::ordered_json{{"error", error.what()}});
  }
  std::fflush(nullptr);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(to, text.data() + done, text.size() - done);
    if (n <= 0) _exit(3);
    done += static_cast<std::size_t>(n);
  }
  _exit(0);
}

/// Reads both pipes to their ends, at most for kSeconds. False if the time was too short.
bool read_both(const std::array<int, 2>& from, std::array<std::string, 2>& texts) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(kSeconds);
  std::array<pollfd, 2> fds{{{from[0], POLLIN, 0}, {from[1], POLLIN, 0}}};
  while (fds[0].fd >= 0) {  // the pipe of the description; what is printed may stay open in a process that remains
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    ::poll(fds.data(), fds.size(), static_cast<int>(left.count()));
    for (std::size_t i = 0; i < fds.size(); ++i) {
      if (fds[i].revents == 0) continue;
      std::array<char, 1 << 14> block{};
      const ssize_t n = ::read(fds[i].fd, block.data(), block.size());
      if (n > 0 && texts[i].size() < kLongestText) texts[i].append(block.data(), static_cast<std::size_t>(n));
      if (n == 0) fds[i].fd = -1;
    }
  }
  return true;
}

std::string described_by_child(const fs::path& library) {
  const std::string name = "the library " + library.filename().string();
  std::array<int, 2> report{};
  std::array<int, 2> printed{};
  if (::pipe2(report.data(), O_CLOEXEC) != 0 || ::pipe2(printed.data(), O_CLOEXEC) != 0)
    throw ForeignFault(name + " cannot be inspected: " + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) tell(library, parent, report[1], printed[1]);
  ::close(report[1]);
  ::close(printed[1]);
  if (pid < 0) throw ForeignFault(name + " cannot be inspected: " + std::strerror(errno));
  ::setpgid(pid, pid);
  std::array<std::string, 2> texts;
  const bool in_time = read_both({report[0], printed[0]}, texts);
  if (!in_time) ::kill(pid, SIGKILL);
  int status = 0;
  ::waitpid(pid, &status, 0);
  ::kill(-pid, SIGKILL);
  remove_confinement(pid);
  ::close(report[0]);
  ::close(printed[0]);
  const std::string tail = texts[1].empty() ? "" : "\n" + output_tail(texts[1]);
  if (!in_time) throw ForeignFault(name + " could not be loaded within " + std::to_string(kSeconds) + " s" + tail);
  if (WIFSIGNALED(status))
    throw ForeignFault(name + " ended its process while it was loaded, by signal " + std::to_string(WTERMSIG(status)) +
                       " (" + strsignal(WTERMSIG(status)) + ")" + tail);
  if (texts[0].empty())
    throw ForeignFault(name + " ended its process while it was loaded, with exit code " +
                       std::to_string(WEXITSTATUS(status)) + tail);
  return texts[0];
}

ForeignModule described_by(const ForeignSource& source, bool sandbox) {
  Program program(source, {.sandbox = sandbox, .writable_folder = {}}, ProgramOutput::captured);
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
  const nlohmann::json list = parsed_json(described_by_child(library));
  if (list.is_object() && list.contains("error")) throw ForeignFault(list["error"].get<std::string>());
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
