// libFuzzer target for the readers of recorded logs.
#include <cstdint>

#include "fuzz/inputs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scanbench::fuzz::run_log({reinterpret_cast<const char*>(data), size});
  return 0;
}
