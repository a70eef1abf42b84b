#include "azulejo/io/orientation.h"

#include <cstddef>
#include <cstring>
#include <utility>

namespace azulejo {
namespace {

/// Copies pixels of `kBytes` along a line whose steps in the result are `step` bytes.
template <std::size_t kBytes>
void scatter(const std::byte* source, int count, std::byte* result, std::ptrdiff_t step) {
  for (int x = 0; x < count; ++x, source += kBytes, result += step) std::memcpy(result, source, kBytes);
}

void scatter_pixels(const std::byte* source, const ImageInfo& info, std::byte* result, std::ptrdiff_t step) {
  switch (info.pixel_bytes()) {
    case 1: return scatter<1>(source, info.width, result, step);
    case 2: return scatter<2>(source, info.width, result, step);
    case 3: return scatter<3>(source, info.width, result, step);
    case 4: return scatter<4>(source, info.width, result, step);
    case 6: return scatter<6>(source, info.width, result, step);
    case 8: return scatter<8>(source, info.width, result, step);
    case 12: return scatter<12>(source, info.width, result, step);
    default: return scatter<16>(source, info.width, result, step);
  }
}

}  // namespace

ImageInfo turned_info(ImageInfo stored, int orientation) {
  if (orientation >= 5) std::swap(stored.width, stored.height);
  return stored;
}

void place_turned_rows(const ConstAnyView& rows, int first, int orientation, const AnyView& upright) {
  const auto pixel = static_cast<std::ptrdiff_t>(rows.info.pixel_bytes());
  const int right = upright.width() - 1;
  const int bottom = upright.height() - 1;
  for (int y = 0; y < rows.height(); ++y) {
    const int at = first + y;  // the stored row
    int column = 0;            // where its first pixel goes, and in which direction the others follow
    int row = at;
    std::ptrdiff_t step = pixel;
    switch (orientation) {
      case 2: column = right, step = -pixel; break;
      case 3: column = right, row = bottom - at, step = -pixel; break;
      case 4: row = bottom - at; break;
      case 5: column = at, row = 0, step = upright.stride; break;
      case 6: column = right - at, row = 0, step = upright.stride; break;
      case 7: column = right - at, row = bottom, step = -upright.stride; break;
      case 8: column = at, row = bottom, step = -upright.stride; break;
      default: break;
    }
    scatter_pixels(rows.row(y), rows.info, upright.row(row) + column * pixel, step);
  }
}

}  // namespace azulejo
