#include "azulejo/charting/chart_text.h"

#include <memory>
#include <utility>

namespace azulejo {

std::string fitted_text(std::string_view text, const TextOptions& options, float width) {
  std::string whole = drawn_text(text);
  if (measure_text(whole, options).width <= width) return whole;
  // The longest beginning that fits, found by halving; never within a character.
  const auto begins_character = [&](std::size_t at) {
    return at >= whole.size() || (static_cast<unsigned char>(whole[at]) & 0xC0) != 0x80;
  };
  const auto shortened = [&](std::size_t bytes) {
    while (!begins_character(bytes)) --bytes;
    while (bytes > 0 && whole[bytes - 1] == ' ') --bytes;
    return whole.substr(0, bytes) + "…";
  };
  std::size_t fits = 0;
  std::size_t too_long = whole.size();
  while (fits + 1 < too_long) {
    const std::size_t middle = (fits + too_long) / 2;
    (measure_text(shortened(middle), options).width <= width ? fits : too_long) = middle;
  }
  return shortened(fits);
}

Run warning_once(const Run& run) {
  Run once = run;
  if (run.warn) {
    once.warn = [warn = run.warn, told = std::make_shared<bool>(false)](const std::string& message) {
      if (!std::exchange(*told, true)) warn(message);
    };
  }
  return once;
}

}  // namespace azulejo
