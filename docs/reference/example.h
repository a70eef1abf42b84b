#pragma once

#include <string>
#include <vector>

#include "azulejo/core/json.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/value.h"

namespace azulejo::reference {

/// The words of a command line, as a shell would take them apart: at spaces, but for what quotes hold together.
std::vector<std::string> words_of(const std::string& text);

/// What the words between `azulejo run` and -o compute, in the current folder. Throws Error.
Value computed(const std::string& words);

/// An image as a screen can show it.
struct Shown {
  Image image;
  std::string note;  ///< what was done to the values for that, a sentence; empty: nothing
};
/// Floats that leave 0–1, or hardly fill it, are scaled; models are rendered.
/// Throws Error(Unsupported) for values that can't be seen.
Shown shown(const Value& value);
Shown shown(const Image& image);

/// JSON for readers: of long lists only how they begin, and how many more there are.
std::string shortened(const Json& json);

}  // namespace azulejo::reference
