#include "azulejo/io/mtl.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/text_numbers.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostExtensions = 64;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Takes a line apart. The text behind it must go on with a byte that belongs to no number.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) { trim(); }

  bool empty() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }
  std::string_view next() {
    std::size_t end = 0;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    trim();
    return word;
  }
  /// The next word, if it is a number.
  std::optional<float> number() {
    float value = 0;
    if (rest_.empty()) return std::nullopt;
    const char* const end = parse_float(rest_.data(), value);
    if (end == nullptr) return std::nullopt;
    const auto size = static_cast<std::size_t>(end - rest_.data());
    if (size < rest_.size() && !is_blank(rest_[size])) return std::nullopt;
    rest_.remove_prefix(size);
    trim();
    return value;
  }

 private:
  void trim() {
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
  }
  std::string_view rest_;
};

/// Up to three numbers, as -s, -o and -t have them; those not given stay.
void read_vector(Words& words, float* values, int most) {
  for (int i = 0; i < 3; ++i) {
    const auto value = words.number();
    if (!value) return;
    if (i < most) values[i] = *value;
  }
}

/// Options, then the file's name, which may hold blanks.
MtlMap read_map(Words words) {
  MtlMap map;
  map.words = std::string(words.rest());
  while (words.rest().starts_with('-')) {
    Words behind = words;
    const std::string option = lower_case(behind.next());
    if (option == "-s") {
      read_vector(behind, &map.scale.x, 2);
    } else if (option == "-o") {
      read_vector(behind, &map.offset.x, 2);
    } else if (option == "-t") {
      read_vector(behind, nullptr, 0);
    } else if (option == "-clamp") {
      map.clamp = lower_case(behind.next()) == "on";
    } else if (option == "-imfchan") {
      const std::string channel = lower_case(behind.next());
      map.channel = channel.empty() ? '\0' : channel[0];
    } else if (option == "-mm") {
      behind.next();
      behind.next();
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-texres" ||
               option == "-type" || option == "-bm" || option == "-boost") {
      behind.next();
    } else {
      break;  // a file whose name begins with -
    }
    words = behind;
  }
  map.file = std::string(words.rest());
  return map;
}

/// A material while its lines are read.
struct Draft {
  MtlMaterial result;
  std::optional<glm::vec3> ambient;
  std::optional<glm::vec3> diffuse;
  std::optional<glm::vec3> specular;
  std::optional<glm::vec3> emissive;
  std::optional<float> shininess;
  std::optional<float> opacity;
  std::optional<float> transparency;
  std::optional<float> roughness;
  std::optional<float> metallic;
  std::optional<float> illumination;

  bool set(const std::string& keyword, Words words);
  void keep(std::string_view keyword, std::string_view text);
  MtlMaterial finished();

 private:
  bool set_color(const std::string& keyword, Words& words);
  bool set_number(const std::string& keyword, Words& words);
  bool set_map(const std::string& keyword, const Words& words);
  void finish_phong();
  void finish_opacity();
};

/// A color of one or three numbers; "spectral" and "xyz" are none.
bool Draft::set_color(const std::string& keyword, Words& words) {
  std::optional<glm::vec3>* const place = keyword == "ka"   ? &ambient
                                          : keyword == "kd" ? &diffuse
                                          : keyword == "ks" ? &specular
                                          : keyword == "ke" ? &emissive
                                                            : nullptr;
  if (place == nullptr) return false;
  const auto red = words.number();
  if (!red) return false;
  const auto green = words.number();
  const auto blue = words.number();
  const auto linear = [](float value) { return mtl_to_linear(value); };
  *place = glm::vec3(linear(*red), linear(green.value_or(*red)), linear(blue.value_or(*red)));
  return true;
}

bool Draft::set_number(const std::string& keyword, Words& words) {
  std::optional<float>* const place = keyword == "ns"      ? &shininess
                                      : keyword == "d"     ? &opacity
                                      : keyword == "tr"    ? &transparency
                                      : keyword == "pr"    ? &roughness
                                      : keyword == "pm"    ? &metallic
                                      : keyword == "illum" ? &illumination
                                                           : nullptr;
  if (place == nullptr) return false;
  if (keyword == "d" && words.rest().starts_with("-halo")) words.next();
  const auto value = words.number();
  if (value) *place = value;
  return value.has_value();
}

bool Draft::set_map(const std::string& keyword, const Words& words) {
  MtlMap* const place = keyword == "map_kd"   ? &result.base_color
                        : keyword == "map_d"  ? &result.alpha
                        : keyword == "map_ks" ? &result.specular
                        : keyword == "map_ke" ? &result.emissive
                        : keyword == "norm"   ? &result.normal
                        : keyword == "map_pr" ? &result.roughness
                        : keyword == "map_pm" ? &result.metallic
                                              : nullptr;
  if (place == nullptr) return false;
  *place = read_map(words);
  return true;
}

bool Draft::set(const std::string& keyword, Words words) {
  return set_color(keyword, words) || set_number(keyword, words) || set_map(keyword, words);
}

void Draft::keep(std::string_view keyword, std::string_view text) {
  Json& kept = result.material.extensions;
  if (kept.is_null()) kept = Json::object();
  if (kept.size() < kMostExtensions) kept.set(keyword, text);
}

void Draft::finish_phong() {
  Material& material = result.material;
  const glm::vec3 base(material.base_color);
  if (ambient) {
    for (int c = 0; c < 3; ++c) material.ambient[c] = base[c] > 0 ? (*ambient)[c] / base[c] : 1.0F;
  }
  material.specular = specular.value_or(glm::vec3(result.specular.file.empty() ? 0.0F : 1.0F));
  if (shininess && *shininess > 0) material.shininess = *shininess;
  if ((shininess && !(*shininess > 0)) || illumination == 1.0F) material.specular = glm::vec3(0.0F);
}

void Draft::finish_opacity() {
  Material& material = result.material;
  if (opacity) {
    material.base_color.w = *opacity;
  } else if (transparency && *transparency < 1) {
    material.base_color.w = 1 - *transparency;
  }
  if (material.base_color.w < 1) material.alpha_mode = AlphaMode::Blend;
}

MtlMaterial Draft::finished() {
  Material& material = result.material;
  material.double_sided = true;
  material.model = illumination == 0.0F    ? MaterialModel::Unlit
                   : roughness || metallic ? MaterialModel::MetalRough
                                           : MaterialModel::Phong;
  const glm::vec3 black(0.0F);
  glm::vec3 base = diffuse.value_or(glm::vec3(1.0F));
  if (base == black && !result.base_color.file.empty()) base = glm::vec3(1.0F);
  material.base_color = glm::vec4(base, 1.0F);
  material.emissive = emissive.value_or(black);
  if (material.emissive == black && !result.emissive.file.empty()) material.emissive = glm::vec3(1.0F);
  material.roughness = roughness.value_or(material.roughness);
  material.metallic = metallic.value_or(material.metallic);
  finish_phong();
  finish_opacity();
  return std::move(result);
}

class MtlParser {
 public:
  MtlParser(std::string_view text, const std::string& name, const Run& run) : text_(text), name_(name), run_(run) {}
  std::vector<MtlMaterial> parsed();

 private:
  void line(std::string_view line);
  void begin_material(std::string_view name);
  void finish_material();

  std::string_view text_;
  const std::string& name_;
  const Run& run_;
  std::optional<Draft> draft_;
  std::vector<MtlMaterial> materials_;
  std::size_t line_number_ = 0;
  std::size_t bad_line_ = 0;
  std::size_t bad_lines_ = 0;
};

void MtlParser::finish_material() {
  if (draft_) materials_.push_back(draft_->finished());
  draft_.reset();
}

void MtlParser::begin_material(std::string_view name) {
  finish_material();
  const auto limit = static_cast<std::size_t>(run_.limits.memory_bytes);
  if (materials_.size() >= limit / sizeof(MtlMaterial)) {
    throw Error(Error::Resource, fmt::format("{}: line {}: {} materials take more than {} bytes, the limit of memory",
                                             name_, line_number_, materials_.size() + 1, limit));
  }
  draft_.emplace().result.material.name = std::string(name);
}

void MtlParser::line(std::string_view line) {
  static constexpr std::array<std::string_view, 10> kNumbers = {"ka", "kd", "ks", "ke", "ns",
                                                                "d",  "tr", "pr", "pm", "illum"};
  Words words(line);
  if (words.empty() || words.rest().starts_with('#')) return;
  const std::string_view keyword = words.next();
  const std::string lower = lower_case(keyword);
  if (lower == "newmtl") return begin_material(words.rest());
  if (draft_ && draft_->set(lower, words)) return;
  if (draft_ && std::find(kNumbers.begin(), kNumbers.end(), lower) == kNumbers.end()) {
    return draft_->keep(keyword, words.rest());
  }
  if (bad_lines_++ == 0) bad_line_ = line_number_;
}

std::vector<MtlMaterial> MtlParser::parsed() {
  for (std::size_t begin = 0; begin < text_.size();) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
    ++line_number_;
    line(text_.substr(begin, end - begin));
    begin = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
  }
  finish_material();
  if (bad_lines_ > 0) {
    warn(run_, fmt::format("{}: line {}: not understood and left out; {} such lines", name_, bad_line_, bad_lines_));
  }
  return std::move(materials_);
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& name, const Run& run) {
  return MtlParser(text, name, run).parsed();
}

TextureUse texture_use(const MtlMap& map, TextureId texture) {
  TextureUse use;
  use.texture = texture;
  use.scale = map.scale;
  // v' = s v + o counts up; 1 − v' = s (1 − v) + (1 − s − o).
  use.offset = {map.offset.x, 1 - map.scale.y - map.offset.y};
  return use;
}

float mtl_to_linear(float value) { return value > 1 ? value : srgb_to_linear(value); }
float linear_to_mtl(float value) { return value > 1 ? value : linear_to_srgb(value); }

}  // namespace azulejo
