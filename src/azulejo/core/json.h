#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// A JSON value. Objects keep the order in which their members were set; floats are written with the fewest
/// digits that read back the same; NaN and infinities become null.
class AZULEJO_EXPORT Json {
 public:
  Json();  ///< null
  Json(bool value);
  Json(int value) : Json(static_cast<std::int64_t>(value)) {}
  Json(std::int64_t value);
  Json(std::uint64_t value);
  Json(float value);
  Json(double value);
  Json(const char* value) : Json(std::string_view(value)) {}
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(std::string_view value);
  static Json array();
  static Json object();
  /// Throws Error(Data) naming `name` and the byte.
  static Json parse(std::string_view text, const std::string& name);

  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(Json other) noexcept;
  ~Json();

  Json& set(std::string_view key, const Json& value);  ///< of an object; returns *this
  Json& push(const Json& value);                       ///< onto an array; returns *this

  bool is_null() const;
  std::size_t size() const;  ///< members or elements; 0 for other values
  bool has(std::string_view key) const;
  Json operator[](std::string_view key) const;  ///< null if there is none
  Json operator[](std::size_t index) const;     ///< null if there is none
  std::vector<std::string> keys() const;
  std::string text(std::string_view otherwise = {}) const;  ///< of a string, else `otherwise`
  double number(double otherwise = 0) const;                ///< of a number, else `otherwise`
  bool truth(bool otherwise = false) const;                 ///< of a boolean, else `otherwise`

  /// indent < 0: on one line. Bytes that are not UTF-8 are replaced.
  std::string dump(int indent = 2) const;

 private:
  struct Value;
  std::unique_ptr<Value> value_;
};

}  // namespace azulejo
