#include "azulejo/core/json.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "azulejo/core/error.h"

namespace azulejo {

struct Json::Value {
  nlohmann::ordered_json json;
};

namespace {

template <class T>
nlohmann::ordered_json finite_or_null(T value) {
  if (!std::isfinite(value)) return nullptr;
  if constexpr (std::is_same_v<T, float>) {
    // The double whose shortest digits are the float's shortest digits.
    return std::strtod(fmt::format("{}", value).c_str(), nullptr);
  } else {
    return value;
  }
}

}  // namespace

Json::Json() : value_(std::make_unique<Value>()) {}
Json::Json(bool value) : value_(new Value{value}) {}
Json::Json(std::int64_t value) : value_(new Value{value}) {}
Json::Json(std::uint64_t value) : value_(new Value{value}) {}
Json::Json(float value) : value_(new Value{finite_or_null(value)}) {}
Json::Json(double value) : value_(new Value{finite_or_null(value)}) {}
Json::Json(std::string_view value) : value_(new Value{std::string(value)}) {}
Json::Json(const Json& other) : value_(std::make_unique<Value>(*other.value_)) {}
Json::Json(Json&& other) noexcept : value_(std::move(other.value_)) {}
Json& Json::operator=(Json other) noexcept {
  value_ = std::move(other.value_);
  return *this;
}
Json::~Json() = default;

Json Json::array() {
  Json json;
  json.value_->json = nlohmann::ordered_json::array();
  return json;
}

Json Json::object() {
  Json json;
  json.value_->json = nlohmann::ordered_json::object();
  return json;
}

Json Json::parse(std::string_view text, const std::string& name) {
  Json json;
  try {
    json.value_->json = nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(Error::Data, fmt::format("{}: byte {}: not JSON", name, error.byte));
  } catch (const nlohmann::json::exception&) {
    throw Error(Error::Data, fmt::format("{}: not JSON: a number out of range", name));
  }
  return json;
}

Json& Json::set(std::string_view key, const Json& value) {
  value_->json[std::string(key)] = value.value_->json;
  return *this;
}

Json& Json::push(const Json& value) {
  value_->json.push_back(value.value_->json);
  return *this;
}

bool Json::is_null() const { return value_->json.is_null(); }
std::size_t Json::size() const { return value_->json.is_structured() ? value_->json.size() : 0; }
bool Json::has(std::string_view key) const {
  return value_->json.is_object() && value_->json.contains(std::string(key));
}

Json Json::operator[](std::string_view key) const {
  Json member;
  if (has(key)) member.value_->json = value_->json[std::string(key)];
  return member;
}

Json Json::operator[](std::size_t index) const {
  Json element;
  if (value_->json.is_array() && index < value_->json.size()) element.value_->json = value_->json[index];
  return element;
}

std::vector<std::string> Json::keys() const {
  std::vector<std::string> names;
  if (value_->json.is_object()) {
    for (const auto& [key, value] : value_->json.items()) names.push_back(key);
  }
  return names;
}

std::string Json::text(std::string_view otherwise) const {
  return value_->json.is_string() ? value_->json.get<std::string>() : std::string(otherwise);
}
double Json::number(double otherwise) const {
  return value_->json.is_number() ? value_->json.get<double>() : otherwise;
}
bool Json::truth(bool otherwise) const { return value_->json.is_boolean() ? value_->json.get<bool>() : otherwise; }

std::string Json::dump(int indent) const {
  return value_->json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace azulejo
