// Composes the command line of bubblewrap.
#include "harness/study/foreign/sandbox.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <system_error>

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;

/// True for the folder itself too.
bool is_within(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool is_within_any(const fs::path& path, const std::vector<fs::path>& folders) {
  return std::ranges::any_of(folders, [&](const fs::path& folder) { return is_within(path, folder); });
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::vector<fs::path> paths_in(const std::string& list) {
  std::vector<fs::path> paths;
  std::istringstream in(list);
  for (std::string path; std::getline(in, path, ':');)
    if (!path.empty()) paths.emplace_back(path);
  return paths;
}

/// Folders that the sandbox shows empty.
std::vector<fs::path> hidden_folders() {
  std::vector<fs::path> hidden;
  for (const fs::path& folder : {fs::path("/run"), fs::path("/tmp"), fs::path("/var/tmp"), fs::path("/dev/shm"),
                                 fs::path("/home"), fs::path("/root"), fs::path(environment("HOME"))}) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (!error && real != real.root_path() && fs::is_directory(real, error) &&
        std::ranges::find(hidden, real) == hidden.end())
      hidden.push_back(real);
  }
  return hidden;
}

/// Where the program's first argument is looked up; empty if it is not found.
fs::path executable_of(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  for (const fs::path& folder : paths_in(environment("PATH"))) {
    std::error_code error;
    if (fs::is_regular_file(folder / name, error)) return folder / name;
  }
  return {};
}

/// What is shown again within the hidden folders.
class Shown {
 public:
  explicit Shown(const std::vector<fs::path>& hidden) : hidden_(hidden) {}

  /// The file's folder; the file alone if its folder is one of those that are hidden, or contains one.
  void add_file(const fs::path& file) {
    for (const fs::path& path : names_of(file)) add(can_show(path.parent_path()) ? path.parent_path() : path);
  }
  void add_folder(const fs::path& folder) {
    for (const fs::path& path : names_of(folder))
      if (can_show(path)) add(path);
  }
  /// An executable, and of one in `bin` or pyenv's `shims` what is installed beside it, like the libraries of a Python.
  void add_executable(const fs::path& file) {
    const fs::path home = environment("HOME");
    for (const fs::path& path : names_of(file)) {
      const fs::path prefix = path.parent_path().parent_path();
      const fs::path folder = path.parent_path().filename();
      const bool is_installed = (folder == "bin" || folder == "shims") && prefix != home / ".local";
      if (is_installed && can_show(prefix))
        add(prefix);
      else
        add(path);
    }
  }
  const std::vector<fs::path>& paths() const { return paths_; }

 private:
  /// The path as it is written and the one that links lead to; none if it does not exist.
  static std::vector<fs::path> names_of(const fs::path& path) {
    std::error_code error;
    if (path.empty() || !fs::exists(path, error)) return {};
    return {fs::absolute(path).lexically_normal(), fs::canonical(path, error)};
  }
  bool can_show(const fs::path& folder) const {
    return std::ranges::none_of(hidden_, [&](const fs::path& hidden) { return is_within(hidden, folder); });
  }
  void add(const fs::path& path) {
    if (is_within_any(path, hidden_) && !is_within_any(path, paths_)) paths_.push_back(path);
  }

  const std::vector<fs::path>& hidden_;
  std::vector<fs::path> paths_;
};

std::vector<fs::path> shown_of(const ForeignSource& source, const std::vector<fs::path>& hidden) {
  Shown shown(hidden);
  shown.add_executable(executable_of(source.program.front()));
  for (std::size_t i = 1; i < source.program.size(); ++i)
    if (source.program[i].find('/') != std::string::npos) shown.add_file(source.program[i]);
  for (const HashedFile& file : source.files) shown.add_file(file.path);
  for (const std::string& file : source.more_files) shown.add_file(file);
  for (const fs::path& folder : paths_in(environment("PYTHONPATH"))) shown.add_folder(folder);
  if (const std::string home = environment("HOME"); !home.empty()) shown.add_folder(fs::path(home) / ".local/lib");
  return shown.paths();
}

/// Files of sockets at which services listen, where this user can reach them and the sandbox shows them. Unknown are
/// those that were opened by a relative path.
std::vector<fs::path> services(const std::vector<fs::path>& hidden, const std::vector<fs::path>& shown) {
  constexpr const char* kListens = " 00010000 ";
  std::vector<fs::path> sockets;
  std::ifstream table("/proc/net/unix");
  for (std::string line; std::getline(table, line);) {
    const std::size_t slash = line.find('/');  // no column before the path has one
    if (slash == std::string::npos || line.find(kListens) == std::string::npos) continue;
    const fs::path path = line.substr(slash);
    std::error_code error;
    if (fs::is_socket(path, error) && (!is_within_any(path, hidden) || is_within_any(path, shown)))
      sockets.push_back(path);
  }
  return sockets;
}

}  // namespace

std::vector<std::string> sandbox_command(const ForeignSource& source, const ForeignSetting& setting) {
  std::vector<std::string> argv{"bwrap",
                                "--unshare-all",
                                "--unshare-user",
                                "--disable-userns",
                                "--cap-drop",
                                "ALL",
                                "--new-session",
                                "--die-with-parent",
                                "--ro-bind",
                                "/",
                                "/",
                                "--proc",
                                "/proc",
                                "--dev",
                                "/dev"};
  const auto add = [&](std::initializer_list<std::string> more) { argv.insert(argv.end(), more); };
  std::vector<std::string> made{"/dev", "/proc"};
  const auto hide = [&](const std::string& folder) {
    add({"--tmpfs", folder});
    made.push_back(folder);
  };
  const std::vector<fs::path> hidden = hidden_folders();
  for (const fs::path& folder : hidden) hide(folder.string());
  const std::vector<fs::path> shown = shown_of(source, hidden);
  for (const fs::path& path : shown) add({"--ro-bind", path.string(), path.string()});
  // A file system that is read-only does not keep a program from connecting to a socket in it.
  for (const fs::path& path : services(hidden, shown)) add({"--ro-bind", "/dev/null", path.string()});
  if (!setting.hidden_folder.empty()) hide(fs::absolute(setting.hidden_folder).lexically_normal().string());
  if (!setting.writable_folder.empty()) {
    const std::string folder = fs::absolute(setting.writable_folder).lexically_normal().string();
    add({"--bind", folder, folder, "--chdir", folder});
  }
  // Memory that a program writes into a file system of its own would not count as its memory. /proc has files that root
  // may write without any capability, like kernel.core_pattern: bubblewrap leaves those of /proc/sys writable.
  for (const std::string& folder : made) add({"--remount-ro", folder});
  add({"--"});
  argv.insert(argv.end(), source.program.begin(), source.program.end());
  return argv;
}

}  // namespace scanbench::study
