// Names that become parts of paths: of scenarios, pipelines, suites, archives. Most come from files that another
// program may have written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace scanbench::io {

/// A name that stays in the folder to which it is appended. Only check_name() makes one.
class FolderName {
 public:
  const std::string& text() const { return text_; }
  friend std::filesystem::path operator/(const std::filesystem::path& folder, const FolderName& name) {
    return folder / name.text_;
  }

 private:
  friend FolderName check_name(const std::string& what, const std::string& name);
  explicit FolderName(std::string text) : text_(std::move(text)) {}
  std::string text_;
};

/// True for 1 to 200 characters without '/' and NUL that do not begin with '.'.
bool is_folder_name(std::string_view name);

/// Throws ConfigError unless is_folder_name(). `what` says whose name it is: "scenario".
FolderName check_name(const std::string& what, const std::string& name);

}  // namespace scanbench::io
