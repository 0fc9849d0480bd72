// Encodes bytes as base64 with OpenSSL.
#include "harness/io/files/base64.hpp"

#include <algorithm>
#include <cstddef>

#include <openssl/evp.h>

namespace scanbench::io {

std::string base64(std::string_view bytes) {
  // EVP takes lengths as int, so the bytes are encoded in pieces. Pieces of whole groups of three bytes need no
  // padding.
  constexpr std::size_t kPiece = std::size_t{3} << 20;
  std::string out;
  out.reserve(4 * ((bytes.size() + 2) / 3));
  std::string piece;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPiece, bytes.size()))) {
    const std::string_view part = bytes.substr(0, kPiece);
    piece.resize(4 * ((part.size() + 2) / 3) + 1);  // EVP writes a zero at the end
    const int length =
        EVP_EncodeBlock(reinterpret_cast<unsigned char*>(piece.data()),
                        reinterpret_cast<const unsigned char*>(part.data()), static_cast<int>(part.size()));
    out.append(piece, 0, static_cast<std::size_t>(length));
  }
  return out;
}

}  // namespace scanbench::io
