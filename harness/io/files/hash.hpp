// SHA-256 of bytes, of files and of the running program.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace scanbench::io {

/// Bytes in, 64 lower-case hex digits out.
class Sha256 {
 public:
  Sha256();
  Sha256& add(std::string_view bytes);
  /// Adds a named part of an address. The name and both lengths are hashed too: different lists of parts give different
  /// bytes.
  Sha256& part(std::string_view name, std::string_view bytes);
  /// The digest. Call it once, last.
  std::string hex();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

std::string sha256_hex(std::string_view bytes);

/// The hash of a regular file, read block by block. Throws ConfigError if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// The same with every occurrence of `text` replaced by as many zero bytes.
std::string sha256_of_file_without(const std::filesystem::path& path, std::string_view text);

}  // namespace scanbench::io
