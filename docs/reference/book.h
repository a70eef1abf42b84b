#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "azulejo/data/image.h"

namespace azulejo::reference {

/// All text of a file. Throws Error(Io).
std::string read_text(const std::string& path);

/// Pages and pictures on their way into a folder. Those to be made are written, those to be checked are held against
/// what is there.
class Book {
 public:
  /// docs  where the files belong
  Book(std::string docs, bool make) : docs_(std::move(docs)), make_(make) {}

  /// A file below the folder.
  void add_text(const std::string& file, const std::string& text) { texts_[file] = text; }
  /// WebP below the folder: lossless where that is smaller, or asked for; at most 480 pixels wide unless it is.
  void add_picture(const std::string& file, const Image& image, bool lossless = false);
  const std::vector<std::byte>& picture(const std::string& file) const { return pictures_.at(file); }
  bool has_picture(const std::string& file) const { return pictures_.contains(file); }
  /// What keeps the pages from being right; each is told at the end.
  void add_fault(const std::string& fault) { faults_.push_back(fault); }

  bool make() const { return make_; }
  const std::string& docs() const { return docs_; }

  /// Writes, or compares. In the `folders`, below the docs, there must be nothing but what was added: it is removed, or
  /// told. False if anything was wrong: it is printed.
  bool finish(const std::vector<std::string>& folders);

 private:
  void write() const;
  void compare();
  std::vector<std::string> strangers(const std::vector<std::string>& folders) const;

  std::string docs_;
  bool make_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::vector<std::byte>> pictures_;  ///< by file; empty where they are only checked
  std::vector<std::string> faults_;
};

}  // namespace azulejo::reference
