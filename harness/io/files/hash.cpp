// SHA-256 through OpenSSL's EVP interface.
#include "harness/io/files/hash.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <openssl/evp.h>

#include "core/error.hpp"
#include "harness/io/files/input_file.hpp"

namespace scanbench::io {

void Sha256::Free::operator()(evp_md_ctx_st* context) const {
  EVP_MD_CTX_free(context);
}

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  SCANBENCH_ASSERT(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

Sha256& Sha256::add(std::string_view bytes) {
  SCANBENCH_ASSERT(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  return *this;
}

Sha256& Sha256::part(std::string_view name, std::string_view bytes) {
  add(std::to_string(name.size())).add(":").add(name);
  return add(std::to_string(bytes.size())).add(":").add(bytes);
}

std::string Sha256::hex() {
  std::array<unsigned char, 32> digest{};
  SCANBENCH_ASSERT(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(64);
  for (const unsigned char byte : digest) {
    text.push_back(kDigits[byte >> 4]);
    text.push_back(kDigits[byte & 15]);
  }
  return text;
}

std::string sha256_hex(std::string_view bytes) {
  return Sha256().add(bytes).hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  InputFile file(path);
  Sha256 hash;
  std::vector<char> block(1 << 16);
  while (const std::size_t n = file.read(block)) hash.add({block.data(), n});
  return hash.hex();
}

std::string sha256_of_file_without(const std::filesystem::path& path, std::string_view text) {
  InputFile file(path);
  std::string bytes;  // whole, because an occurrence may cross the end of a block
  std::vector<char> block(1 << 16);
  while (const std::size_t n = file.read(block)) bytes.append(block.data(), n);
  for (std::size_t at = text.empty() ? std::string::npos : bytes.find(text); at != std::string::npos;
       at = bytes.find(text, at + text.size()))
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), text.size(), '\0');
  return sha256_hex(bytes);
}

}  // namespace scanbench::io
