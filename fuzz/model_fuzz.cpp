// Any bytes into the reader of one model format: a value or an Error, within the limits given.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <variant>

#include "azulejo/core/error.h"
#include "azulejo/io/model_codec.h"

namespace azulejo {
namespace {

Run small_run() {
  Run run;
  run.threads = 1;
  run.limits.pixels = std::int64_t{1} << 22;
  run.limits.memory_bytes = std::int64_t{256} << 20;
  run.limits.temporary_bytes = 0;
  return run;
}

const ModelCodec& codec_named(std::string_view name) {
  for (const ModelCodec* codec : model_codecs()) {
    if (codec->name == name) return *codec;
  }
  std::abort();
}

/// As `read_model` does with what a reader gives: what it let through is an Error here.
void check(const Model& model) {
  if (const auto* const mesh = std::get_if<Mesh>(&model)) mesh->check("fuzz");
  if (const auto* const drawing = std::get_if<Drawing>(&model)) drawing->check("fuzz");
  if (const auto* const scene = std::get_if<Scene>(&model)) {
    for (const auto& mesh : scene->meshes) mesh->check("fuzz");
    scene->check("fuzz");
  }
}

}  // namespace
}  // namespace azulejo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace azulejo;
  static const ModelCodec& codec = codec_named(AZULEJO_FUZZ_FORMAT);
  static const Run run = small_run();
  const auto bytes = std::as_bytes(std::span(data, size));
  ModelReadOptions options;
  if (codec.name == std::string_view("raw")) {
    options.raw = RawVolume{.width = 3, .height = 2, .depth = 2, .type = SampleType::I16, .skip_bytes = 1};
  }
  codec.matches(bytes.first(std::min<std::size_t>(size, 512)), size, "fuzz");
  try {
    check(codec.read({memory_input(bytes, "fuzz"), {}}, options, run));
  } catch (const Error& error) {
    if (error.kind() == Error::Cancelled || error.kind() == Error::Argument) std::abort();
  }
  return 0;
}
