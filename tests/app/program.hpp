// Runs the built program as a child process, for all tests of this folder.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/places.hpp"

namespace scanbench::app_test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

namespace fs = std::filesystem;

inline std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder of the test's own; in memory if possible, because a run flushes its files to disk.
class Folder {
 public:
  Folder() {
    const fs::path memory = "/dev/shm";
    const fs::path parent = access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path();
    std::string name = (parent / "scanbench-app-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const fs::path& name) const { return path_ / name; }
  fs::path write(const fs::path& name, const std::string& bytes) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  fs::path path_;
};

struct Outcome {
  int code = -1;  ///< exit code; 1000 + signal if one ended the program
  std::string out, err;
};

using Args = std::vector<std::string>;
using Env = std::map<std::string, std::string>;

/// The running program, which a test may interrupt() and wait() for.
class Child {
 public:
  Child(const Args& command, const Env& env, const fs::path& cwd) {
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork");
    if (pid_ > 0) return;
    const auto send_to = [&](const char* name, int fd) {
      dup2(open((logs_.path() / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), fd);
    };
    send_to("out", STDOUT_FILENO);
    send_to("err", STDERR_FILENO);
    if (!cwd.empty() && chdir(cwd.c_str()) != 0) _exit(126);
    for (const auto& [key, value] : env) setenv(key.c_str(), value.c_str(), 1);
    std::vector<char*> argv;
    for (const auto& arg : command) argv.push_back(const_cast<char*>(arg.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  ~Child() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  void interrupt(int signal = SIGINT) const { kill(pid_, signal); }

  /// Waits until the condition holds. False: the program ended before, or a minute passed.
  template <class Condition>
  bool wait_until(Condition&& holds) const {
    for (int i = 0; i < 60000; ++i) {
      if (holds()) return true;
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0)
        return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  std::string err_so_far() const { return read(logs_.path() / "err"); }

  Outcome wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read(logs_.path() / "out"),
            read(logs_.path() / "err")};
  }

 private:
  Folder logs_;
  pid_t pid_ = -1;
};

inline Args command(Args args) {
  args.insert(args.begin(), places::program());
  return args;
}

/// The program with these arguments.
inline Outcome run(const Args& args, const Env& env = {}, const fs::path& cwd = {}) {
  return Child(command(args), env, cwd).wait();
}

/// Path and bytes of every file under a folder; links as what they point to.
inline std::map<std::string, std::string> files(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) found[entry.path().lexically_relative(folder).string()] = read(entry.path());
  return found;
}

/// The arrays and tables of a run that must not depend on jobs or interruptions.
inline std::map<std::string, std::string> results(const fs::path& run_folder) {
  auto found = files(run_folder);
  std::erase_if(found, [](const auto& file) {
    const fs::path path = file.first;
    return path.filename() == "timing.csv" || (path.extension() != ".npy" && path.extension() != ".csv");
  });
  return found;
}

/// Names of files that were being written when the program ended; there must be none.
inline std::vector<std::string> half_written(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().find(".tmp-") != std::string::npos) names.push_back(entry.path().string());
  return names;
}

/// Names of files whose bytes differ, or that only one side has.
inline std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                            const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) names.push_back(name);
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names.push_back(name);
  return names;
}

/// A rectangular room, five scans along its diagonal, one pipeline.
inline std::string room() {
  return R"(schema: 1
world:
  segments:
    - [a, 0, 0, 10, 0]
    - [b, 10, 0, 10, 8]
    - [c, 10, 8, 0, 8]
    - [d, 0, 8, 0, 0]
sensor: {preset: sick_lms200}
trajectory: {kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 5}
pipelines:
  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}
metrics: [segments]
figures: [environment]
)";
}

/// room() with one piece of its text replaced.
inline std::string room_with(const std::string& piece, const std::string& replacement) {
  std::string text = room();
  const auto at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("the room has no '" + piece + "'");
  return text.replace(at, piece.size(), replacement);
}

inline std::string abcdef() {
  return places::source_dir() / "scenarios/abcdef.yaml";
}

}  // namespace scanbench::app_test
