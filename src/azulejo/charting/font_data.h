#pragma once

#include <cstddef>
#include <span>

namespace azulejo {

/// The bytes of DejaVuSans.ttf, or DejaVuSans-Bold.ttf, as they were when the library was built.
std::span<const std::byte> font_data(bool bold);

}  // namespace azulejo
