#include "azulejo/engine/value.h"

namespace azulejo {

const char* to_string(ValueKind kind) {
  switch (kind) {
    case ValueKind::Image: return "image";
    case ValueKind::Labels: return "labels";
    case ValueKind::Report: return "report";
  }
  return "unknown";
}

}  // namespace azulejo
