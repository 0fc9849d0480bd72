// Ways out of the sandbox, each tried from inside a program, as this user and, where this user is root, as another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A socket that listens, as a service of the machine does.
class Listener {
 public:
  /// At a port of this machine.
  Listener() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    listen_at(&address, sizeof address);
  }
  /// At a file, or at a name that belongs to the network and is not a file.
  Listener(const std::string& name, bool is_file) : socket_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::size_t at = is_file ? 0 : 1;
    name.copy(address.sun_path + at, sizeof address.sun_path - at - 1);
    listen_at(&address, offsetof(sockaddr_un, sun_path) + name.size() + 1);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { close(socket_); }

  int port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

 private:
  void listen_at(const void* address, std::size_t size) const {
    if (bind(socket_, static_cast<const sockaddr*>(address), static_cast<socklen_t>(size)) != 0 ||
        listen(socket_, 8) != 0)
      throw std::runtime_error("no socket");
  }

  int socket_;
};

constexpr auto kWays = {"remount", "terminal", "fifo",    "links", "sockets", "network",      "processes",  "truth",
                        "results", "files",    "signals", "trace", "storm",   "core_pattern", "descriptors"};

/// Those that work without the sandbox whoever the user is, and do no harm to the machine.
const std::set<std::string> kOpenWithoutSandbox{"terminal",  "fifo",  "links",   "sockets", "network",
                                                "processes", "truth", "results", "files",   "signals"};

class SandboxEscapes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
    if (GetParam() == "nobody") {
      if (getuid() != 0) GTEST_SKIP() << "only root can become another user";
      as_user_ = {"PATH=/usr/bin:/bin", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
      if (chown(folder_.path().c_str(), 65534, 65534) != 0) GTEST_SKIP() << "the folder cannot be given away";
      if (shell({places::program(), "--version"}).code != 0) GTEST_SKIP() << "nobody cannot execute the program";
      if (shell({"python3", "-c", "pass"}).code != 0) GTEST_SKIP() << "nobody cannot execute python3";
    }
    if (shell({"bwrap", "--unshare-all", "--ro-bind", "/", "/", "true"}).code != 0)
      GTEST_SKIP() << "bubblewrap is not installed or not allowed";
    victim_ = std::make_unique<Child>(as_user({"sleep", "600"}), Env{}, fs::path());
  }
  /// A command of the user, looked up in PATH.
  Args as_user(const Args& args) const {
    Args all{"/usr/bin/env"};
    all.insert(all.end(), as_user_.begin(), as_user_.end());
    all.insert(all.end(), args.begin(), args.end());
    return all;
  }
  Outcome shell(const Args& args) const { return Child(as_user(args), {}, folder_.path()).wait(); }

  fs::path scenario() const {
    const std::string source = places::source_dir().string();
    std::string pipelines;
    folder_.write("module/data", "that the module reads");
    for (const std::string way : kWays)
      pipelines += "  - {name: " + way + ", extract: {program: [python3, '" + source + "/tests/plugins/escapes.py', " +
                   way + "], files: ['" + source + "/clients/scanbench.py', module/data]}}\n";
    return folder_.write(
        "room.yaml", room_with("  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}\n", pipelines));
  }
  /// Runs all ways at a terminal. The result is what each says.
  std::map<std::string, std::string> tried(const std::string& run, const Args& options) const {
    const fs::path out = folder_ / run;
    const fs::path service = folder_ / (folder_.path().filename().string() + "-service");  // a name of this test alone
    fs::remove(service);
    // The sandbox shows the folder of the module, which is beside this one.
    const fs::path shown = folder_ / "module/service";
    fs::create_directories(shown.parent_path());
    fs::remove(shown);
    const Listener local(service.string(), true), beside(shown.string(), true),
        abstract(service.filename().string(), false), tcp;
    for (const fs::path& socket : {service, shown}) fs::permissions(socket, fs::perms::all);
    Args args{"python3",
              "-c",
              "import os, pty, sys; sys.exit(os.waitstatus_to_exitcode(pty.spawn(sys.argv[1:])))",
              places::program(),
              "run",
              scenario(),
              "--out",
              out,
              "--no-figures",
              "-q"};
    args.insert(args.end(), options.begin(), options.end());
    const Outcome outcome = Child(as_user(args),
                                  {{"ESCAPE_RUN", out},
                                   {"ESCAPE_FILE", folder_ / "outside"},
                                   {"ESCAPE_SOCKET", service},
                                   {"ESCAPE_SHOWN_SOCKET", shown},
                                   {"ESCAPE_PORT", std::to_string(tcp.port())},
                                   {"ESCAPE_PROCESS", std::to_string(victim_->pid())}},
                                  folder_.path())
                                .wait();
    EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
    std::map<std::string, std::string> said;
    for (const std::string way : kWays) {
      const std::string status = read(out / "cells/room" / way / "1/status.json");
      const auto json = nlohmann::json::parse(status, nullptr, false);
      said[way] = json.is_object() ? json.value("message", "") : "no status: " + status;
    }
    return said;
  }
  nlohmann::json manifest(const std::string& run) const {
    return nlohmann::json::parse(read(folder_ / run / "manifest.json"));
  }

  Folder folder_;
  Args as_user_;
  std::unique_ptr<Child> victim_;
};

TEST_P(SandboxEscapes, AreRefused) {
  const auto said = tried("closed", {"--sandbox"});
  const bool limited = manifest("closed").dump().find("pids.max") != std::string::npos || getuid() != 0;
  for (const auto& [way, message] : said) {
    if (way != "storm" || limited) {
      EXPECT_THAT(message, HasSubstr("refused: ")) << way;
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "outside"));
  const auto sandbox = manifest("closed").at("sandbox").at("programs");
  EXPECT_GE(sandbox.size(), 8u);
  for (const auto& [what, active] : sandbox.items()) EXPECT_EQ(active, true) << what;
  EXPECT_THAT(manifest("closed").at("without_sandbox"), IsEmpty());
}

TEST_P(SandboxEscapes, AreOpenWithoutIt) {
  const auto said = tried("open", {});
  for (const std::string& way : kOpenWithoutSandbox) EXPECT_THAT(said.at(way), HasSubstr("ESCAPED: ")) << way;
  EXPECT_THAT(said.at("descriptors"), HasSubstr("refused: has [0, 1, 2, 3]"));
  EXPECT_TRUE(fs::exists(folder_ / "outside"));
  const nlohmann::json of_run = manifest("open");
  for (const auto& [what, active] : of_run.at("sandbox").at("programs").items()) EXPECT_EQ(active, false) << what;
  EXPECT_THAT(of_run.at("without_sandbox").dump(), HasSubstr("extract escapes of python3 escapes.py files"));
}

INSTANTIATE_TEST_SUITE_P(Users, SandboxEscapes, testing::Values("this_user", "nobody"),
                         [](const auto& user) { return user.param; });

}  // namespace
}  // namespace scanbench::app_test
