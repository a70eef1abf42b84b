// Counts the bright pixels of a picture: the least that a program with azulejo is made of.
#include <azulejo/data/image.h>
#include <azulejo/imaging/threshold.h>

#include <cstdint>
#include <cstdio>

int main() {
  azulejo::Image ramp(256, 16, 1);
  const azulejo::ImageView<std::uint8_t> pixels = ramp.view<std::uint8_t>();
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) pixels(x, y) = static_cast<std::uint8_t>(x);
  }

  const azulejo::Image bright = azulejo::threshold(ramp, {.level = 0.75F});
  const azulejo::ImageView<const std::uint8_t> mask = bright.view<std::uint8_t>();
  int count = 0;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) count += mask(x, y) != 0 ? 1 : 0;
  }
  std::printf("%d of %d pixels are brighter than 0.75\n", count, mask.width * mask.height);
  return count == 64 * 16 ? 0 : 1;
}
