#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "azulejo/data/array.h"
#include "azulejo/io/gltf_file.h"

namespace azulejo {

/// Numbers in a buffer, as glTF describes them. All that its members say was checked against the file.
struct GltfAccessor {
  enum Component : std::uint32_t { I8 = 5120, U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };
  static constexpr std::size_t kNoView = static_cast<std::size_t>(-1);

  Component component = F32;
  int components = 1;   ///< of an element: 1–4, 16 of MAT4
  bool matrix = false;  ///< of the three matrix types
  bool normalized = false;
  std::size_t count = 0;       ///< elements
  std::size_t view = kNoView;  ///< none: zeros
  std::uint64_t offset = 0;    ///< of the first element in the view
  std::uint64_t stride = 0;    ///< from an element to the next

  std::size_t sparse_count = 0;  ///< elements that are replaced
  Component sparse_component = U32;
  std::size_t sparse_indices = kNoView;
  std::uint64_t sparse_indices_offset = 0;
  std::size_t sparse_values = kNoView;
  std::uint64_t sparse_values_offset = 0;

  std::size_t values() const { return count * static_cast<std::size_t>(components); }
};

/// All accessors of a file. Views may be unaligned, interleaved or overlap.
class GltfAccessors {
 public:
  /// Checks them all, used or not: types, strides, and that every element lies in its view. `file` must outlive it.
  explicit GltfAccessors(GltfFile& file);

  /// The accessor that a value names. Error(Data) where it names none.
  const GltfAccessor& at(const GltfValue& index) const { return accessors_[index.index(accessors_.size())]; }
  /// The same, of so many components.
  const GltfAccessor& at(const GltfValue& index, int components) const;

  /// All values into a `target` of accessor.values(). Normalized integers become 0 … 1 or −1 … 1, others their value.
  /// Sparse elements are laid over the others. `place` stands in messages.
  void read(const GltfAccessor& accessor, const GltfValue& place, std::span<float> target);
  /// The same as integers; the components must be unsigned integers that fit.
  void read(const GltfAccessor& accessor, const GltfValue& place, std::span<std::uint32_t> target);
  void read(const GltfAccessor& accessor, const GltfValue& place, std::span<std::uint8_t> target);

 private:
  GltfAccessor parse(const GltfValue& value) const;
  void parse_sparse(const GltfValue& value, GltfAccessor& accessor) const;
  void check_in_view(const GltfValue& value, std::size_t view, std::uint64_t offset, std::uint64_t count,
                     std::uint64_t stride, std::uint64_t size) const;
  template <class T>
  void read_as(const GltfAccessor& accessor, const GltfValue& place, std::span<T> target);

  GltfFile& file_;
  std::vector<GltfAccessor> accessors_;
};

}  // namespace azulejo
