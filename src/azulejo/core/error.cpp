#include "azulejo/core/error.h"

namespace azulejo {

const char* to_string(Error::Kind kind) {
  switch (kind) {
    case Error::Argument: return "argument";
    case Error::Data: return "data";
    case Error::Unsupported: return "unsupported";
    case Error::Io: return "io";
    case Error::Resource: return "resource";
    case Error::Cancelled: return "cancelled";
  }
  return "unknown";
}

}  // namespace azulejo
