// libFuzzer target for the reader of tables of walls.
#include <cstdint>

#include "fuzz/inputs.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scanbench::fuzz::run_world({reinterpret_cast<const char*>(data), size});
  return 0;
}
