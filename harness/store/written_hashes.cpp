// The hashes of written files: lines in a temporary file, a folder's name before the names of its files.
#include "harness/store/written_hashes.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "harness/files/hash.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;

std::string hash_line(const std::string& name, const std::string& sha256) {
  return name + " " + sha256 + "\n";
}

std::string hash_lines(const fs::path& folder) {
  std::string lines;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && !entry.is_symlink())
      lines += hash_line(entry.path().filename().string(), sha256_of_file(entry.path()));
  return lines;
}

WrittenHashes::WrittenHashes() : file_(std::tmpfile()) {}

void WrittenHashes::add(const fs::path& folder, const std::string& lines) {
  if (!file_) return;
  const std::string text = folder.generic_string() + "\n" + lines + "\n";  // an empty line ends the folder
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0)
    file_.reset();
}

std::map<std::string, std::string> WrittenHashes::take() {
  std::map<std::string, std::string> hashes;
  const auto file = std::exchange(file_, nullptr);
  if (!file) return hashes;
  std::rewind(file.get());
  std::string text;
  std::array<char, 1 << 16> block{};
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), file.get())) text.append(block.data(), n);
  std::string folder;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    const std::size_t blank = line.rfind(' ');
    if (line.empty())
      folder.clear();
    else if (folder.empty())
      folder = line;
    else
      hashes.insert_or_assign(folder + "/" + std::string(line.substr(0, blank)), line.substr(blank + 1));
  }
  return hashes;
}

}  // namespace scanbench::harness
