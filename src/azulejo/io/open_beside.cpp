#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/model_codec.h"

namespace azulejo {
namespace {

namespace fs = std::filesystem;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// %20 and its like are undone.
std::string unescaped(const std::string& name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const int high = name[i] == '%' && i + 2 < name.size() ? hex_digit(name[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(name[i + 2]) : -1;
    if (low < 0) {
      result += name[i];
    } else {
      result += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return result;
}

/// Whether `path` lies in `folder`; both absolute and without links.
bool lies_in(const fs::path& path, const fs::path& folder) {
  const auto [end_of_folder, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end_of_folder == folder.end() || (end_of_folder->empty() && std::next(end_of_folder) == folder.end());
}

}  // namespace

std::shared_ptr<const Input> open_beside(const ModelFile& file, const std::string& name,
                                         const ModelReadOptions& options, const Run& run) {
  if (file.folder.empty() || name.empty()) return nullptr;
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  // A file may really be called a%20b: the name as it stands goes first.
  for (const std::string& candidate : {slashed, unescaped(slashed)}) {
    if (candidate.find('\0') != std::string::npos) continue;
    std::error_code failure;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file.folder, failure), failure);
    const fs::path path = fs::weakly_canonical(folder / candidate, failure);
    if (failure) continue;  // a name too long, links in a circle: nothing can be there
    if (!options.outside && !lies_in(path, folder)) {
      throw Error(Error::Data, fmt::format("{}: names the file '{}', which lies outside its folder {}",
                                           file.input->name(), name, file.folder));
    }
    if (fs::is_regular_file(path, failure)) return open_input(path.string(), run.limits.memory_bytes);
  }
  return nullptr;
}

}  // namespace azulejo
