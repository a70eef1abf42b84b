#include "azulejo/engine/value.h"

#include "azulejo/core/error.h"

namespace azulejo {

ValueKind Value::kind() const {
  if (empty()) throw Error(Error::Argument, "a value is empty");
  return static_cast<ValueKind>(value_.index() - 1);
}

const char* to_string(ValueKind kind) {
  switch (kind) {
    case ValueKind::Image: return "image";
    case ValueKind::Labels: return "labels";
    case ValueKind::Report: return "report";
    case ValueKind::Mesh: return "mesh";
    case ValueKind::Scene: return "scene";
    case ValueKind::Volume: return "volume";
    case ValueKind::Frame: return "frame";
    case ValueKind::Drawing: return "drawing";
  }
  return "unknown";
}

}  // namespace azulejo
