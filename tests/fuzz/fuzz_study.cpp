#include "tests/fuzz/h5_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cleft::fuzz::read_edited_study(data, size);
  return 0;
}
