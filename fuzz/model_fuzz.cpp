// Any bytes into the reader of one format of models: a value that passes its checks or an Error, within the limits given.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace azulejo;
  Run run;
  run.threads = 1;
  run.limits.pixels = std::int64_t{1} << 22;
  run.limits.memory_bytes = std::int64_t{256} << 20;
  run.limits.temporary_bytes = 0;
  try {
    // Its ending tells the format where the bytes don't.
    read_model(std::as_bytes(std::span(data, size)), "fuzz." AZULEJO_FUZZ_FORMAT, {}, run);
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || error.kind() == Error::Argument) std::abort();
  }
  return 0;
}
