// A libFuzzer program of one target; TELESTRAIN_FUZZ_FUNCTION is its function.
#include <algorithm>
#include <cstdint>

#include "robustness/fuzz/fuzz_target.h"
#include "robustness/fuzz/json_mutation.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telestrain::fuzz::TELESTRAIN_FUZZ_FUNCTION({reinterpret_cast<const char*>(data), size});
  return 0;
}

// Bytes are changed half of the time, values of JSON otherwise.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  const auto changed =
      telestrain::fuzz::MutateJson({reinterpret_cast<const char*>(data), size}, seed);
  if (!changed || changed->size() > most) return LLVMFuzzerMutate(data, size, most);
  std::copy(changed->begin(), changed->end(), data);
  return changed->size();
}
