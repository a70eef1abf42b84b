#pragma once

#include <memory>
#include <string>
#include <variant>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/image.h"
#include "azulejo/data/labels.h"

namespace azulejo {

enum class ValueKind { Image, Labels, Report };

/// A result that is measured, not drawn: what a report says is JSON.
struct Report {
  Json json = Json::object();
  bool verdict = true;  ///< false: the command exits with status 3
};

/// Anything that flows from one operation to the next. Shared, never changed.
class Value {
 public:
  Value() = default;
  Value(Image image) : value_(std::make_shared<const Image>(std::move(image))) {}
  Value(Labels labels) : value_(std::make_shared<const Labels>(std::move(labels))) {}
  Value(Report report) : value_(std::make_shared<const Report>(std::move(report))) {}

  bool empty() const { return value_.index() == 0; }
  /// Null if it is of another kind.
  const Image* image() const { return get<Image>(); }
  const Labels* labels() const { return get<Labels>(); }
  const Report* report() const { return get<Report>(); }

 private:
  template <class T>
  const T* get() const {
    const auto* held = std::get_if<std::shared_ptr<const T>>(&value_);
    return held != nullptr ? held->get() : nullptr;
  }
  std::variant<std::monostate, std::shared_ptr<const Image>, std::shared_ptr<const Labels>,
               std::shared_ptr<const Report>>
      value_;
};

/// "image", "labels", "report"
AZULEJO_EXPORT const char* to_string(ValueKind kind);

}  // namespace azulejo
