#include "azulejo/engine/united_report.h"

#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace azulejo {
namespace {

/// The number that a value is, if it is one.
std::optional<double> number_of(const Json& value) {
  const double number = value.number(0);
  return number == value.number(1) ? std::optional(number) : std::nullopt;
}

Json json_of(double sum) {
  constexpr double kExact = 9007199254740992;  // 2^53: whole numbers up to here are exact
  return sum == std::floor(sum) && std::fabs(sum) <= kExact ? Json(static_cast<std::int64_t>(sum)) : Json(sum);
}

}  // namespace

Report united(std::span<const NamedReport> reports) {
  std::vector<std::string> keys;
  std::map<std::string, double> sums;
  Json meshes = Json::array();
  Report all;
  for (const auto& [name, report] : reports) {
    Json entry = Json::object().set("name", name);
    for (const std::string& key : report->json.keys()) {
      const Json value = report->json[key];
      entry.set(key, value);
      const std::optional<double> number = number_of(value);
      if (!number) continue;
      const auto [sum, added] = sums.emplace(key, 0);
      sum->second += *number;
      if (added) keys.push_back(key);
    }
    meshes.push(entry);
    all.verdict = all.verdict && report->verdict;
  }
  for (const std::string& key : keys) all.json.set(key, json_of(sums[key]));
  all.json.set("meshes", meshes);
  return all;
}

}  // namespace azulejo
