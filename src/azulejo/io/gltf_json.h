#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/json.h"

namespace azulejo {

class GltfText;

/// What a file calls something, fit for a message: at most 100 bytes, on one line.
std::string printable(std::string_view text);

/// A place in the JSON of a glTF file, where a value may be or not be. All that is asked of it and doesn't hold is
/// Error(Data) naming the file and the place. Cheap to copy; must not outlive its GltfText.
class GltfValue {
 public:
  GltfValue() = default;
  explicit operator bool() const { return value_ != nullptr; }  ///< something is there; null counts as nothing
  bool is_object() const;
  bool is_array() const;
  bool is_text() const;

  /// A member of an object; nothing if there is none, or if this is nothing.
  GltfValue operator[](std::string_view member) const;
  GltfValue need(std::string_view member) const;                        ///< must be there
  std::vector<std::pair<std::string_view, GltfValue>> members() const;  ///< that are there, by name

  std::size_t size() const;            ///< of an array; 0 for nothing
  GltfValue at(std::size_t at) const;  ///< at < size()

  float number(float otherwise) const;  ///< finite
  bool truth(bool otherwise) const;
  std::string text() const;                            ///< "" for nothing
  std::uint64_t count(std::uint64_t otherwise) const;  ///< a whole number in 0 … 2^53
  std::size_t index(std::size_t size) const;           ///< must be there, and less than `size`
  template <std::size_t kCount>
  std::array<float, kCount> numbers(const std::array<float, kCount>& otherwise) const {
    std::array<float, kCount> result = otherwise;
    if (value_ != nullptr) read_numbers(result);
    return result;
  }
  std::vector<float> numbers() const;  ///< of an array of any size

  std::string dump() const;  ///< its JSON
  Json json() const;         ///< a copy; null if it has an object of more members than a Json bears
  bool has_no_more_than(std::size_t members) const;  ///< in each of its objects

  Error error(const std::string& what) const { return error(Error::Data, what); }
  /// "NAME: nodes[3].mesh: WHAT". Cost O(the whole text): it looks for the place.
  Error error(Error::Kind kind, const std::string& what) const;

 private:
  friend class GltfText;
  GltfValue(const GltfText* text, const nlohmann::json* value) : text_(text), value_(value) {}
  void read_numbers(std::span<float> target) const;
  Error wrong_type(const char* wanted) const;

  const GltfText* text_ = nullptr;
  const nlohmann::json* value_ = nullptr;
};

/// The JSON of a glTF file, parsed. It is refused where it nests deeper than any real file does, so whatever walks
/// over a value may call itself.
class GltfText {
 public:
  /// `name` stands in messages; `offset` is where the text begins in the file.
  GltfText(std::string_view text, std::string name, std::size_t offset);
  ~GltfText();
  GltfText(const GltfText&) = delete;
  GltfText& operator=(const GltfText&) = delete;

  GltfValue root() const;
  const std::string& name() const { return name_; }
  std::string place(const nlohmann::json* value) const;

 private:
  std::string name_;
  std::unique_ptr<nlohmann::json> root_;
};

}  // namespace azulejo
