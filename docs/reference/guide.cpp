#include "guide.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/text_file.h"
#include "example.h"

namespace azulejo::reference {
namespace {

struct Ran {
  std::string printed;  ///< on both outputs
  bool success = false;
};

/// Runs a line of shell, with the folder of the command in front of the path.
Ran ran(const std::string& line, const std::string& command) {
  const std::string folder = std::filesystem::path(command).parent_path().string();
  const std::string shell = fmt::format("export PATH='{}':\"$PATH\"; {{ {}\n}} 2>&1", folder, line);
  std::FILE* const pipe = popen(shell.c_str(), "r");
  if (pipe == nullptr) throw Error(Error::Resource, "sh: can't be started");
  Ran result;
  std::array<char, 4096> part{};
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
    result.printed.append(part.data(), count);
  result.success = pclose(pipe) == 0;
  return result;
}

/// A page on its way from line to line.
class Guide {
 public:
  Guide(Book& book, std::string file, std::string command)
      : book_(book), file_(std::move(file)), command_(std::move(command)) {}

  std::string read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) take(line);
    return result_;
  }

 private:
  void take(const std::string& line) {
    if (line.starts_with("```")) {
      if (is_file()) write_text_file(block_.substr(block_.find(' ') + 1), file_text_);
      file_text_.clear();
      block_ = block_.empty() ? (line.size() > 3 ? line.substr(3) : "plain") : "";
    } else if (is_file()) {
      file_text_ += line + "\n";
    } else if (block_ == "sh") {
      collect(line);
    } else if (block_ == "console") {
      if (!line.starts_with("$ ") && pending_.empty()) return;  // what was printed the last time
      result_ += line + "\n";
      collect(pending_.empty() ? line.substr(2) : line);
      return;
    }
    result_ += line + "\n";
  }

  /// A command goes on behind a backslash at the end of a line.
  void collect(const std::string& line) {
    pending_ += line;
    if (line.ends_with('\\')) {
      pending_.back() = ' ';
      return;
    }
    const std::string whole = std::exchange(pending_, "");
    const Ran done = ran(whole, command_);
    if (block_ == "console")
      result_ += done.printed;
    else if (!done.success || !done.printed.empty())
      book_.add_fault(fmt::format("{}: {}: {}", file_, whole,
                                  done.printed.empty() ? "failed" : done.printed.substr(0, done.printed.find('\n'))));
  }

  /// Whether the block is a file: its mark is a language and a name.
  bool is_file() const { return block_.find(' ') != std::string::npos; }

  Book& book_;
  std::string file_;
  std::string command_;
  std::string file_text_;  ///< of a block that is a file
  std::string block_;      ///< what the block is marked with; empty: outside of blocks
  std::string pending_;    ///< a command that isn't whole yet
  std::string result_;
};

/// The file of that name, whatever its ending. Throws Error(Data) if no command wrote one.
std::string written(const std::string& name) {
  for (const char* ending : {".png", ".exr", ".jpg", ".webp", ".tif"}) {
    if (std::filesystem::exists(name + ending)) return name + ending;
  }
  throw Error(Error::Data, fmt::format("no command wrote {}", name));
}

void add_pictures(Book& book, const std::string& file, const std::string& text) {
  const std::string page = std::filesystem::path(file).stem().string();
  const std::regex link(fmt::format(R"(pictures/{}/([^./]+)\.webp)", page));
  for (auto match = std::sregex_iterator(text.begin(), text.end(), link); match != std::sregex_iterator(); ++match) {
    try {
      book.add_picture((*match)[0], shown(read_image(written((*match)[1]))).image);
    } catch (const Error& error) {
      book.add_fault(fmt::format("{}: {}: {}", file, (*match)[0].str(), error.what()));
    }
  }
}

}  // namespace

void add_guide(Book& book, const std::string& file, const std::string& command) {
  const std::string text = Guide(book, file, command).read(read_text(book.docs() + "/" + file));
  add_pictures(book, file, text);
  book.add_text(file, text);
}

}  // namespace azulejo::reference
