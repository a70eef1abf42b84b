#include "example.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/rendering/draw.h"
#include "azulejo/rendering/render.h"
#include "command_line.h"
#include "run_command.h"

namespace azulejo::reference {
namespace {

constexpr std::size_t kElements = 6;  // of a list, that are told

/// The finite colors of an image, without alpha.
std::vector<float> colors_of(const Image& image) {
  std::vector<float> colors;
  const auto view = image.view<float>();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (int channel = 0; channel < image.info().color_channels(); ++channel) {
        if (std::isfinite(view(x, y, channel))) colors.push_back(view(x, y, channel));
      }
    }
  }
  return colors;
}

/// What but a few values don't exceed in size: those few would leave the rest without contrast.
float reach_of(std::vector<float> values) {
  for (float& value : values) value = std::abs(value);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 199 / 200);
  std::nth_element(values.begin(), place, values.end());
  return *place > 0 ? *place : *std::max_element(values.begin(), values.end());
}

Image scaled(const Image& image, float scale, float offset) {
  Image result = image.clone();
  const auto view = result.view<float>();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (int channel = 0; channel < image.info().color_channels(); ++channel)
        view(x, y, channel) = view(x, y, channel) * scale + offset;
    }
  }
  return result;
}

/// A value that is no list and no object.
bool is_plain(const Json& json) { return json.size() == 0; }

std::string shortened(const Json& json, const std::string& indent) {
  if (is_plain(json)) return json.dump(-1);
  const std::vector<std::string> keys = json.keys();
  const std::string inner = indent + "  ";
  if (!keys.empty()) {
    std::string text = "{";
    for (const std::string& key : keys)
      text += fmt::format("{}\n{}\"{}\": {}", key == keys[0] ? "" : ",", inner, key, shortened(json[key], inner));
    return text + "\n" + indent + "}";
  }
  const std::size_t told = json.size() <= 2 * kElements ? json.size() : kElements;
  bool plain = true;
  for (std::size_t i = 0; i < told; ++i) plain = plain && is_plain(json[i]);
  std::string text = "[";
  for (std::size_t i = 0; i < told; ++i) {
    if (i > 0) text += plain ? ", " : ",";
    text += plain ? json[i].dump(-1) : "\n" + inner + shortened(json[i], inner);
  }
  if (told < json.size()) text += fmt::format(", … {} more", json.size() - told);
  return text + (plain ? "]" : "\n" + indent + "]");
}

}  // namespace

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  bool begun = false;
  for (const char c : text) {
    if (quote == 0 && c == ' ') {
      if (begun) words.push_back(word);
      word.clear();
      begun = false;
      continue;
    }
    begun = true;
    if (c == quote)
      quote = 0;
    else if (quote == 0 && (c == '\'' || c == '"'))
      quote = c;
    else
      word += c;
  }
  if (begun) words.push_back(word);
  return words;
}

Value computed(const std::string& text) {
  std::vector<std::string> words = words_of(text);
  words.insert(words.begin(), {"azulejo", "run"});
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  return cli::chain_of(cli::parse_command_line(static_cast<int>(pointers.size()), pointers.data()), {}).compute();
}

Shown shown(const Image& image) {
  if (image.type() != PixelType::F32) return {image.clone(), ""};
  constexpr float kDim = 0.25F;  // what doesn't even reach this is hard to see
  const std::vector<float> colors = colors_of(image);
  if (colors.empty()) return {image.clone(), ""};
  const auto [minimum, maximum] = std::minmax_element(colors.begin(), colors.end());
  const float reach = reach_of(colors);
  if (*minimum < 0) {
    return {scaled(image, 0.5F / reach, 0.5F),
            fmt::format("Shown with 0 as middle gray, −{0:.3g} as black and {0:.3g} as white.", reach)};
  }
  if (*maximum > 1 || (*maximum<kDim&& * maximum> 0))
    return {scaled(image, 1 / reach, 0), fmt::format("Shown with {:.3g} as white.", reach)};
  return {image.clone(), ""};
}

Shown shown(const Value& value) {
  if (value.image() != nullptr) return shown(*value.image());
  if (value.frame() != nullptr && !value.frame()->layers.empty()) return shown(value.frame()->layers[0].image);
  const RenderOptions options{.width = 480, .height = 360, .background = Color{1, 1, 1, 1}};
  if (value.scene() != nullptr) return {shown(Value(render(*value.scene(), options))).image, "Shown by `render`."};
  if (value.mesh() != nullptr)
    return {shown(Value(render(scene_of(value.mesh()->clone()), options))).image, "Shown by `render`."};
  if (value.drawing() != nullptr) {
    const bool large = value.drawing()->width >= 320;
    DrawOptions page;
    page.background = Color{1, 1, 1, 1};
    if (!large) page.width = 480;
    return {draw(*value.drawing(), page), ""};
  }
  throw Error(Error::Unsupported, fmt::format("a {} can't be shown", to_string(value.kind())));
}

std::string shortened(const Json& json) { return shortened(json, ""); }

}  // namespace azulejo::reference
