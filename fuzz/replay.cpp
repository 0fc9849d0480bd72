// Runs a fuzz target on files, for compilers without libFuzzer.
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "harness/files/text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 20;
  for (int i = 1; i < argc; ++i) {
    const std::string bytes = scanbench::harness::read_text_file(argv[i], kMaxBytes);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%d files\n", argc - 1);
  return argc > 1 ? 0 : 1;
}
