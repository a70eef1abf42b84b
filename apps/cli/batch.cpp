#include "batch.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/text_file.h"

namespace azulejo::cli {
namespace {

constexpr std::string_view kPlace = "{name}";

/// Size and modification time in nanoseconds; zeros if there is no such file.
struct Stamp {
  std::int64_t size = 0;
  std::int64_t time = 0;
};

Stamp stamp(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {};
  return {static_cast<std::int64_t>(status.st_size), status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec};
}

std::int64_t now() {
  timespec time{};
  // The clock that files are stamped with: a file written after this is not older.
  clock_gettime(CLOCK_REALTIME_COARSE, &time);
  return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

}  // namespace

bool is_batch(const std::vector<std::string>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const std::string& each) { return each.find(kPlace) != std::string::npos; });
}

std::vector<std::string> outputs_for(const std::vector<std::string>& outputs, const std::string& input) {
  const std::string name = std::filesystem::path(input).stem().string();
  std::vector<std::string> result = outputs;
  for (std::string& each : result) {
    for (std::size_t at = each.find(kPlace); at != std::string::npos; at = each.find(kPlace, at + name.size())) {
      each.replace(at, kPlace.size(), name);
    }
  }
  return result;
}

std::string path_of_output(const std::string& output) {
  const std::size_t equals = output.find('=');
  if (equals == std::string::npos || equals == 0) return output;
  const bool named =
      std::all_of(output.begin(), output.begin() + static_cast<std::ptrdiff_t>(equals),
                  [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-'; });
  return named ? output.substr(equals + 1) : output;
}

Manifest::Manifest(std::string path, std::string command) : path_(std::move(path)), command_(std::move(command)) {
  std::ifstream file(path_);
  std::string line;
  while (std::getline(file, line)) {
    try {
      const Json entry = Json::parse(line, path_);
      const std::string key = entry["files"][std::size_t{0}].text();
      if (!key.empty()) items_.insert_or_assign(key, entry);
    } catch (const Error&) {
      // The last line of a killed batch may be cut: its item is simply not done.
    }
  }
}

Json Manifest::entry(const Item& item, const char* state) const {
  const Stamp input = stamp(item.input);
  Json files = Json::array();
  for (const std::string& file : item.files) files.push(file);
  return Json::object()
      .set("files", files)
      .set("state", state)
      .set("input", item.input)
      .set("size", input.size)
      .set("time", std::to_string(input.time))
      .set("at", std::to_string(now()))
      .set("command", command_);
}

bool Manifest::is_done(const Item& item) const {
  if (item.input == "-") return false;  // who knows what came through it then
  const std::lock_guard lock(mutex_);
  const auto found = items_.find(item.files[0]);
  if (found == items_.end()) return false;
  const Json& was = found->second;
  const Stamp input = stamp(item.input);
  if (was["command"].text() != command_ || was["input"].text() != item.input ||
      static_cast<std::int64_t>(was["size"].number()) != input.size ||
      was["time"].text() != std::to_string(input.time) || was["files"].size() != item.files.size()) {
    return false;
  }
  const bool finished = was["state"].text() == "done";
  for (std::size_t i = 0; i < item.files.size(); ++i) {
    const Stamp file = stamp(item.files[i]);
    if (was["files"][i].text() != item.files[i] || file.time == 0) return false;
    // Killed between the renaming of its last file and the line that says so: files appear whole or not at all,
    // so those that are newer than the item's beginning are its results.
    if (!finished && file.time < std::strtoll(was["at"].text("0").c_str(), nullptr, 10)) return false;
  }
  return true;
}

void Manifest::append(const Json& line) {
  const std::lock_guard lock(mutex_);
  const std::string text = line.dump(-1) + "\n";
  const int file = open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const bool written = file >= 0 && write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (file >= 0) close(file);
  if (!written)
    throw Error(Error::Io, fmt::format("{}: can't write the batch's manifest: {}", path_, std::strerror(reason)));
  items_.insert_or_assign(line["files"][std::size_t{0}].text(), line);
}

void Manifest::begin(const Item& item) { append(entry(item, "begun")); }
void Manifest::done(const Item& item) { append(entry(item, "done")); }

void Manifest::compact() {
  const std::lock_guard lock(mutex_);
  if (items_.empty()) return;
  std::string text;
  for (const auto& [key, line] : items_) text += line.dump(-1) + "\n";
  write_text_file(path_, text);
}

}  // namespace azulejo::cli
