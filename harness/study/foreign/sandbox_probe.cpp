// Starts a shell in the sandbox and compares its view with that of this process.
#include "harness/study/foreign/sandbox_probe.hpp"

#include <filesystem>
#include <sstream>
#include <system_error>

#include "harness/io/process/child.hpp"
#include "harness/io/process/pipe.hpp"
#include "harness/study/foreign/sandbox.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;

constexpr double kProbeSeconds = 10.0;

/// Writes words "NAME VALUE".
constexpr const char* kLook =
    "for n in user net pid mnt ipc; do echo $n $(readlink /proc/self/ns/$n); done; "
    "while read -r name value rest; do case $name in Cap[EPB]*:|NoNewPrivs:) echo $name $value;; esac; done "
    "</proc/self/status; "
    "read -r pid name state parent group session rest </proc/self/stat; echo session $session; "
    "[ -w / ] || echo root read-only";

std::map<std::string, std::string> seen_in_sandbox() {
  ForeignSource shell;
  shell.program = {"/bin/sh", "-c", kLook};
  std::map<std::string, std::string> seen;
  try {
    io::Pipe printed = io::make_pipe();
    io::Child child =
        io::start_program(sandbox_command(shell, {}),
                          {.output = printed.write_end.number(), .errors = io::kNullDevice, .own_group = true});
    printed.write_end.close();
    io::PipeReader output(std::move(printed.read_end), io::kOutputKept);
    child.wait(kProbeSeconds, {&output});
    std::istringstream words(output.bytes());
    for (std::string name, value; words >> name >> value;) seen[name] = value;
  } catch (const std::system_error&) {
    seen.clear();  // bubblewrap is missing
  }
  return seen;
}

}  // namespace

std::map<std::string, bool> sandbox_facts(bool look) {
  std::map<std::string, std::string> seen;
  if (look) seen = seen_in_sandbox();
  const auto has_own = [&](const std::string& name) {
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/ns/" + name, error);
    return !error && !seen[name].empty() && seen[name] != here;
  };
  const auto is_zero = [&](const std::string& name) {
    return !seen[name].empty() && seen[name].find_first_not_of('0') == std::string::npos;
  };
  return {{"own user namespace", has_own("user")},
          {"own process namespace", has_own("pid")},
          {"own session", !seen["session"].empty() && seen["session"] != "0"},
          {"own shared memory", has_own("ipc")},
          {"no network", has_own("net")},
          {"no capabilities", is_zero("CapEff:") && is_zero("CapPrm:") && is_zero("CapBnd:")},
          {"no new privileges", seen["NoNewPrivs:"] == "1"},
          {"read-only file systems", has_own("mnt") && seen["root"] == "read-only"}};
}

}  // namespace scanbench::study
