#include "azulejo/io/gltf_json.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace azulejo {
namespace {

constexpr int kDeepest = 200;                         ///< of brackets; files nest about ten
constexpr double kLargestCount = 9007199254740992.0;  ///< 2^53: up to here doubles are whole numbers
constexpr std::size_t kMembers = 1000;  ///< of an object that is kept as a Json, which searches one by one

void check_depth(std::string_view text, const std::string& name, std::size_t offset) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (quoted) {
      if (letter == '\\') ++i;
      quoted = letter != '"';
    } else if (letter == '"') {
      quoted = true;
    } else if (letter == '[' || letter == '{') {
      if (++depth > kDeepest) {
        throw Error(Error::Data,
                    fmt::format("{}: byte {}: JSON nested deeper than {} levels", name, offset + i, kDeepest));
      }
    } else if (letter == ']' || letter == '}') {
      --depth;
    }
  }
}

/// Where `wanted` is below `value`, as ".nodes[3].mesh"; false if it isn't.
bool find(const nlohmann::json& value, const nlohmann::json* wanted, std::string& place) {
  if (&value == wanted) return true;
  const std::size_t length = place.size();
  if (value.is_object()) {
    for (const auto& [key, member] : value.get_ref<const nlohmann::json::object_t&>()) {
      place += (length == 0 ? "" : ".") + key;
      if (find(member, wanted, place)) return true;
      place.resize(length);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      place += fmt::format("[{}]", i);
      if (find(value[i], wanted, place)) return true;
      place.resize(length);
    }
  }
  return false;
}

bool narrow(const nlohmann::json& value, std::size_t members) {
  if (value.is_object() && value.size() > members) return false;
  if (!value.is_structured()) return true;
  return std::all_of(value.begin(), value.end(), [&](const nlohmann::json& each) { return narrow(each, members); });
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result(text.substr(0, 100));
  for (char& letter : result) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7F) letter = '?';
  }
  return result;
}

GltfText::GltfText(std::string_view text, std::string name, std::size_t offset) : name_(std::move(name)) {
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);  // some writers pad chunks with zeros
  check_depth(text, name_, offset);
  try {
    root_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(text));
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(Error::Data, fmt::format("{}: byte {}: not JSON", name_, offset + error.byte));
  } catch (const nlohmann::json::exception&) {
    throw Error(Error::Data, fmt::format("{}: not JSON: a number out of range", name_));
  }
  if (!root_->is_object()) throw Error(Error::Data, fmt::format("{}: JSON, but not an object", name_));
}

GltfText::~GltfText() = default;

GltfValue GltfText::root() const { return {this, root_.get()}; }

std::string GltfText::place(const nlohmann::json* value) const {
  std::string place;
  find(*root_, value, place);
  return printable(place);
}

Error GltfValue::error(Error::Kind kind, const std::string& what) const {
  const std::string place = text_->place(value_);
  return Error(kind, fmt::format("{}: {}{}{}", text_->name(), place, place.empty() ? "" : ": ", what));
}

Error GltfValue::wrong_type(const char* wanted) const {
  return error(fmt::format("{}, expected {}", value_->type_name(), wanted));
}

bool GltfValue::is_object() const { return value_ != nullptr && value_->is_object(); }
bool GltfValue::is_array() const { return value_ != nullptr && value_->is_array(); }
bool GltfValue::is_text() const { return value_ != nullptr && value_->is_string(); }

GltfValue GltfValue::operator[](std::string_view member) const {
  if (value_ == nullptr) return {};
  if (!value_->is_object()) throw wrong_type("an object");
  const auto found = value_->find(member);
  if (found == value_->end() || found->is_null()) return {};
  return {text_, &*found};
}

GltfValue GltfValue::need(std::string_view member) const {
  const GltfValue found = (*this)[member];
  if (!found) throw error(fmt::format("no {}", member));
  return found;
}

std::vector<std::pair<std::string_view, GltfValue>> GltfValue::members() const {
  std::vector<std::pair<std::string_view, GltfValue>> result;
  if (value_ == nullptr) return result;
  if (!value_->is_object()) throw wrong_type("an object");
  for (const auto& [key, member] : value_->get_ref<const nlohmann::json::object_t&>()) {
    if (!member.is_null()) result.emplace_back(key, GltfValue(text_, &member));
  }
  return result;
}

std::size_t GltfValue::size() const {
  if (value_ == nullptr) return 0;
  if (!value_->is_array()) throw wrong_type("an array");
  return value_->size();
}

GltfValue GltfValue::at(std::size_t at) const { return {text_, &(*value_)[at]}; }

float GltfValue::number(float otherwise) const {
  if (value_ == nullptr) return otherwise;
  if (!value_->is_number()) throw wrong_type("a number");
  const double number = value_->get<double>();
  if (std::abs(number) > std::numeric_limits<float>::max()) throw error(fmt::format("{} is out of range", number));
  return static_cast<float>(number);
}

bool GltfValue::truth(bool otherwise) const {
  if (value_ == nullptr) return otherwise;
  if (!value_->is_boolean()) throw wrong_type("true or false");
  return value_->get<bool>();
}

std::string GltfValue::text() const {
  if (value_ == nullptr) return {};
  if (!value_->is_string()) throw wrong_type("a string");
  return value_->get<std::string>();
}

std::uint64_t GltfValue::count(std::uint64_t otherwise) const {
  if (value_ == nullptr) return otherwise;
  if (!value_->is_number()) throw wrong_type("a number");
  const double number = value_->get<double>();
  if (!(number >= 0 && number <= kLargestCount) || number != std::floor(number)) {
    throw error(fmt::format("{}, expected a whole number from 0", number));
  }
  return static_cast<std::uint64_t>(number);
}

std::size_t GltfValue::index(std::size_t size) const {
  const std::uint64_t index = count(0);
  if (index >= size) throw error(fmt::format("{}, of {}", index, size));
  return static_cast<std::size_t>(index);
}

void GltfValue::read_numbers(std::span<float> target) const {
  if (size() != target.size()) throw error(fmt::format("{} numbers, expected {}", size(), target.size()));
  for (std::size_t i = 0; i < target.size(); ++i) target[i] = at(i).number(0);
}

std::vector<float> GltfValue::numbers() const {
  std::vector<float> result(size());
  read_numbers(result);
  return result;
}

std::string GltfValue::dump() const { return value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); }

bool GltfValue::has_no_more_than(std::size_t members) const { return narrow(*value_, members); }

Json GltfValue::json() const { return has_no_more_than(kMembers) ? Json::parse(dump(), text_->name()) : Json(); }

}  // namespace azulejo
