// Keeps the hashes of written files as a list in a temporary file.
#include "harness/runs/store/written_hashes.hpp"

#include <array>
#include <cstddef>
#include <utility>

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

constexpr const char* kWrittenList = "the hashes of written files";

}  // namespace

WrittenHashes::WrittenHashes() : file_(std::tmpfile()) {}

void WrittenHashes::add(const fs::path& folder, const std::string& lines) {
  if (!file_) return;
  std::string text;
  for (const auto& [name, hash] : io::parse_hash_list(lines, kWrittenList))
    text += io::hash_line((folder / name).generic_string(), hash);
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0)
    file_.reset();
}

io::FileHashes WrittenHashes::take() {
  const auto file = std::exchange(file_, nullptr);
  if (!file) return {};
  std::rewind(file.get());
  std::string text;
  std::array<char, 1 << 16> block{};
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), file.get())) text.append(block.data(), n);
  return io::parse_hash_list(text, kWrittenList);
}

}  // namespace scanbench::runs
