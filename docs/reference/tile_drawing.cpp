#include "tile_drawing.h"

#include <fmt/format.h>

namespace azulejo::reference {
namespace {

constexpr int kTile = 80;
constexpr int kColumns = 4;
constexpr int kRows = 3;

/// A tile from (0, 0) to (80, 80): a flower of eight leaves, quarter circles in the corners, a rim.
constexpr const char* kFlower = R"svg(
    <rect width="80" height="80" fill="url(#glaze)"/>
    <g fill="none" stroke="#1d4f91" stroke-width="2.5">
      <circle r="22"/><circle cx="80" r="22"/><circle cy="80" r="22"/><circle cx="80" cy="80" r="22"/>
    </g>
    <g fill="#e8b23a">
      <circle r="13"/><circle cx="80" r="13"/><circle cy="80" r="13"/><circle cx="80" cy="80" r="13"/>
    </g>
    <g transform="translate(40 40)" stroke="#12305c" stroke-linejoin="round">
{}
      <circle r="7.5" fill="url(#heart)" stroke-width="1.2"/>
    </g>
    <rect x="0.5" y="0.5" width="79" height="79" fill="none" stroke="#9fb4c9"/>
)svg";

std::string leaves() {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const bool large = i % 2 == 0;
    text += fmt::format(
        "      <path transform=\"rotate({})\" d=\"{}\" fill=\"{}\" stroke-width=\"1.2\"/>\n", 45 * i,
        large ? "M0 -6C11 -14 9 -26 0 -35C-9 -26 -11 -14 0 -6Z" : "M0 -6C7 -12 6 -20 0 -27C-6 -20 -7 -12 0 -6Z",
        large ? "url(#leaf)" : "#7fa8d8");
  }
  return text;
}

}  // namespace

std::string tile_drawing() {
  std::string text =
      fmt::format(R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">
  <defs>
    <linearGradient id="glaze" x2="1" y2="1"><stop offset="0" stop-color="#fdfdf8"/><stop offset="1" stop-color="#d9e3ea"/></linearGradient>
    <linearGradient id="leaf" x2="0" y2="1"><stop offset="0" stop-color="#153e7a"/><stop offset="1" stop-color="#5d8fd0"/></linearGradient>
    <radialGradient id="heart" fx="0.35" fy="0.3"><stop offset="0" stop-color="#fff2c4"/><stop offset="1" stop-color="#d98e1f"/></radialGradient>
    <radialGradient id="light" cx="0.25" cy="0.2" r="0.9"><stop offset="0" stop-color="#fff" stop-opacity="0.5"/><stop offset="1" stop-color="#031230" stop-opacity="0.55"/></radialGradient>
    <clipPath id="arch"><path d="M20 220V110A140 95 0 0 1 300 110V220Z"/></clipPath>
  </defs>
)svg",
                  kTile * kColumns, kTile * kRows);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      text += fmt::format("  <g transform=\"translate({} {})\">", column * kTile, row * kTile);
      text += fmt::format(fmt::runtime(kFlower), leaves());
      text += "  </g>\n";
    }
  }
  text += R"svg(  <rect width="100%" height="100%" fill="url(#light)"/>
  <g clip-path="url(#arch)">
    <g opacity="0.8" fill="#0b2a55" stroke="#f4f1e4" stroke-width="3">
      <rect width="320" height="240" stroke="none"/>
      <circle cx="125" cy="140" r="62"/><circle cx="195" cy="140" r="62" fill="#b8452f"/>
    </g>
    <path d="M160 62L172 122L232 134L172 146L160 206L148 146L88 134L148 122Z" fill="#f0c24b" stroke="#7a5310" stroke-width="2" stroke-linejoin="round"/>
  </g>
</svg>
)svg";
  return text;
}

}  // namespace azulejo::reference
