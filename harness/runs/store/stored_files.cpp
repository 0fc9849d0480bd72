// Reads files of a cell or recording from its folder or from memory.
#include "harness/runs/store/stored_files.hpp"

#include <utility>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;

StoredFiles::StoredFiles(fs::path folder) : folder_(std::move(folder)) {}

StoredFiles::StoredFiles(fs::path folder, FolderFiles archived)
    : folder_(std::move(folder)), archived_(std::move(archived)) {}

bool StoredFiles::exist() const {
  return archived_ || fs::exists(folder_);
}

bool StoredFiles::has(const std::string& name) const {
  return archived_ ? archived_->contains(name) : fs::exists(path(name));
}

std::string StoredFiles::read(const std::string& name) const {
  if (!archived_) return io::read_file(path(name));
  const auto found = archived_->find(name);
  if (found == archived_->end()) throw ConfigError("the archive has no file " + path(name).string());
  return found->second;
}

io::CsvTable StoredFiles::table(const std::string& name, const std::vector<std::string>& required) const {
  return {read(name), path(name), required};
}

}  // namespace scanbench::runs
