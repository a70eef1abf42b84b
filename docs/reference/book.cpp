#include "book.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/imaging/resize.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/text_file.h"

namespace azulejo::reference {
namespace {

constexpr int kWidest = 480;
constexpr int kQuality = 72;  // below, tiles and grain begin to smear

std::vector<std::byte> webp(const Image& image, bool lossless) {
  return encode_image(image, "webp", {.quality = kQuality, .lossless = lossless, .type = PixelType::U8});
}

/// The first line in which two texts differ, from 1.
int first_difference(const std::string& a, const std::string& b) {
  std::istringstream lines_of_a(a);
  std::istringstream lines_of_b(b);
  std::string line_of_a;
  std::string line_of_b;
  for (int line = 1;; ++line) {
    const bool more_of_a = static_cast<bool>(std::getline(lines_of_a, line_of_a));
    const bool more_of_b = static_cast<bool>(std::getline(lines_of_b, line_of_b));
    if (!more_of_a || !more_of_b || line_of_a != line_of_b) return line;
  }
}

}  // namespace

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(Error::Io, path + ": can't be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void Book::add_picture(const std::string& file, const Image& image, bool lossless) {
  if (!make_) {
    pictures_[file] = {};
    return;
  }
  if (lossless) {
    pictures_[file] = webp(image, true);
    return;
  }
  const Image small = image.width() > kWidest ? resize(image, {.width = kWidest}) : image.clone();
  std::vector<std::byte> exact = webp(small, true);
  std::vector<std::byte> near = webp(small, false);
  pictures_[file] = std::move(exact.size() <= near.size() ? exact : near);
}

void Book::write() const {
  for (const auto& [file, text] : texts_) {
    std::filesystem::create_directories(std::filesystem::path(docs_ + "/" + file).parent_path());
    write_text_file(docs_ + "/" + file, text);
  }
  for (const auto& [file, bytes] : pictures_) {
    std::filesystem::create_directories(std::filesystem::path(docs_ + "/" + file).parent_path());
    write_text_file(docs_ + "/" + file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
}

void Book::compare() {
  for (const auto& [file, text] : texts_) {
    const std::string path = docs_ + "/" + file;
    if (!std::filesystem::exists(path)) {
      add_fault(path + ": is missing");
      continue;
    }
    const std::string committed = read_text(path);
    if (committed != text) add_fault(fmt::format("{}:{}: is out of date", path, first_difference(committed, text)));
  }
  for (const auto& [file, bytes] : pictures_) {
    if (!std::filesystem::exists(docs_ + "/" + file)) add_fault(docs_ + "/" + file + ": is missing");
  }
}

std::vector<std::string> Book::strangers(const std::vector<std::string>& folders) const {
  std::vector<std::string> found;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(docs_ + "/" + folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(docs_ + "/" + folder)) {
      if (entry.is_directory()) continue;
      const std::string file = folder + "/" + entry.path().filename().string();
      if (!texts_.contains(file) && !pictures_.contains(file)) found.push_back(docs_ + "/" + file);
    }
  }
  return found;
}

bool Book::finish(const std::vector<std::string>& folders) {
  if (make_)
    write();
  else
    compare();
  for (const std::string& path : strangers(folders)) {
    if (!make_)
      add_fault(path + ": belongs to nothing");
    else if (faults_.empty())
      std::filesystem::remove(path);
  }
  for (const std::string& fault : faults_) fmt::print(stderr, "{}\n", fault);
  if (!faults_.empty()) {
    fmt::print(stderr, "{} faults in docs/operations and the guides{}\n", faults_.size(),
               make_ ? "" : "; make reference makes them anew");
  }
  return faults_.empty();
}

}  // namespace azulejo::reference
