#pragma once

#include <stdexcept>
#include <string>

#include "azulejo/core/export.h"

namespace azulejo {

/// The one exception type. Its message is a single line: what was asked, the argument or file (and byte or
/// line), the value got and the value wanted.
class AZULEJO_EXPORT Error : public std::runtime_error {
 public:
  enum Kind {
    Argument,     ///< a wrong call: an option out of range, inputs that don't fit together
    Data,         ///< a file or value is malformed
    Unsupported,  ///< well-formed, and beyond what azulejo does
    Io,           ///< the operating system refused
    Resource,     ///< a limit of `Run` would be passed
    Cancelled,    ///< `Run::cancel` was set
  };

  Error(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  Kind kind() const noexcept { return kind_; }

 private:
  Kind kind_;
};

/// "argument", "data", …: as printed in reports.
AZULEJO_EXPORT const char* to_string(Error::Kind kind);

}  // namespace azulejo
