#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "azulejo/io/gltf_json.h"
#include "azulejo/io/model_codec.h"

namespace azulejo {

/// A glTF or GLB file that is being read: its JSON, its buffers, and how much may still be made of them.
class GltfFile {
 public:
  /// Reads the JSON, and checks the version, the required extensions, and every buffer view against its buffer.
  /// `file`, `options` and `run` must outlive it.
  GltfFile(const ModelFile& file, const ModelReadOptions& options, const Run& run);

  GltfValue root() const { return text_->root(); }
  const std::string& name() const { return file_.input->name(); }
  const ModelReadOptions& options() const { return options_; }
  const Run& run() const { return run_; }

  std::size_t view_count() const { return views_.size(); }
  std::uint64_t view_size(std::size_t view) const { return views_[view].size; }
  std::uint64_t view_stride(std::size_t view) const { return views_[view].stride; }  ///< 0: tightly packed
  /// The bytes of a view; its buffer is read when first asked for. Not for several threads at once.
  std::span<const std::byte> view(std::size_t view);
  /// What a URI names: the bytes of a data: URI, or those of a file beside the model; nothing if there is no such
  /// file. Error(Data) for a malformed URI.
  std::optional<std::vector<std::byte>> fetch(const std::string& uri) const;

  /// Says that `bytes` will be allocated for what the file describes. Error(Resource) where all claims together pass
  /// the smaller of `run.limits.memory_bytes` and 256 MiB + 64 times the bytes read: honest files, which may show
  /// one buffer a hundred times, stay below; a count that was made up doesn't.
  void claim(std::uint64_t count, std::uint64_t bytes_each);

  /// One line, with the file's name before it.
  void warn(const std::string& what) const { azulejo::warn(run_, name() + ": " + what); }

 private:
  struct View {
    std::size_t buffer = 0;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::uint64_t stride = 0;
    bool packed = false;  ///< its bytes can be had by EXT_meshopt_compression only
  };
  struct Buffer {
    std::uint64_t size = 0;  ///< as the JSON says
    bool read = false;
    std::vector<std::byte> bytes;
  };

  void read_binary();
  void read_text();
  void check_asset() const;
  void read_views();
  const std::vector<std::byte>& buffer(std::size_t index);
  std::vector<std::byte> bytes_of(const GltfValue& value, std::size_t index);
  std::vector<std::byte> read_bytes(std::uint64_t offset, std::uint64_t count);

  const ModelFile& file_;
  const ModelReadOptions& options_;
  const Run& run_;
  std::unique_ptr<GltfText> text_;
  std::uint64_t binary_offset_ = 0;  ///< of the BIN chunk
  std::uint64_t binary_size_ = 0;
  bool has_binary_ = false;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::uint64_t bytes_read_ = 0;
  std::uint64_t bytes_claimed_ = 0;
};

}  // namespace azulejo
