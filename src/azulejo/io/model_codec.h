#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/io/input.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// A model file that was opened, and how it comes to the files that it names.
struct ModelFile {
  std::shared_ptr<const Input> input;  ///< unpacked, if it was packed with gzip; input->name() for messages
  std::string folder;                  ///< where it lies; empty: it may name no other files (memory, standard input)
};

/// Opens a file that a model names. The name may use \ for / and %20 for a space; it must stay in the model's folder
/// (after links are followed) unless options.outside.
/// Null if there is no such file: the caller decides whether that is an error.
/// Throws Error(Data) for a name that leaves the folder, Error(Io).
std::shared_ptr<const Input> open_beside(const ModelFile& file, const std::string& name,
                                         const ModelReadOptions& options, const Run& run);

/// One model format. A codec is a constant; model_codecs.cpp lists them.
struct ModelCodec {
  const char* name;                       ///< "stl"
  std::vector<std::string_view> endings;  ///< "stl"; the first is the usual one
  /// Whether a file begins like this format; `head` has up to 512 bytes, `size` is the file's.
  bool (*matches)(std::span<const std::byte> head, std::uint64_t size, std::string_view name);
  Model (*read)(const ModelFile& file, const ModelReadOptions& options, const Run& run);
  /// One of these, or neither: the format is only read. `output` is at its start; the caller commits it.
  void (*write_mesh)(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run);
  /// Files beside the model (MTL, textures) go into `folder`, "" is nowhere, and are named after `stem`.
  void (*write_scene)(Output& output, const Scene& scene, const std::string& folder, const std::string& stem,
                      const ModelWriteOptions& options, const Run& run);
  /// Of a format that holds drawings: alone among the three.
  void (*write_drawing)(Output& output, const Drawing& drawing, const ModelWriteOptions& options,
                        const Run& run) = nullptr;

  bool is_written() const { return write_mesh != nullptr || write_scene != nullptr || write_drawing != nullptr; }
};

/// All formats, in the order in which their `matches` are asked.
std::span<const ModelCodec* const> model_codecs();

}  // namespace azulejo
