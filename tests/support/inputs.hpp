// Shared by the tests of input files: places, temporary files, messages of refusals.
#pragma once

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"

namespace scanbench::support {

using places::data_dir;
using places::source_dir;

/// The message of the ConfigError that the work throws, "" if it throws none.
template <class Work>
std::string config_refusal(Work&& work) {
  try {
    work();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

inline std::string gzip(const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "x.gz").string();
  gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(out);
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace scanbench::support
