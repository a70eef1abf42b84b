#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "azulejo/core/json.h"

namespace azulejo::cli {

/// True if an output has `{name}` in it.
bool is_batch(const std::vector<std::string>& outputs);

/// `outputs` with `{name}` replaced by the input's file name without its ending.
std::vector<std::string> outputs_for(const std::vector<std::string>& outputs, const std::string& input);

/// The part of an output that is a path: behind `name=`, if that is there.
std::string path_of_output(const std::string& output);

/// What a batch has done, kept in `.azulejo-batch.jsonl` beside its results: a line when an item begins and one
/// when it is done. A killed batch goes on where it stopped. Thread-safe.
class Manifest {
 public:
  /// Reads the file, if there is one. `command` is everything that an item's result depends on but its input.
  Manifest(std::string path, std::string command);

  struct Item {
    std::string input;
    std::vector<std::string> files;  ///< that it writes
  };
  /// True if the item was done by the same command from the same input (by size and time), and its files are there.
  bool is_done(const Item& item) const;
  void begin(const Item& item);
  void done(const Item& item);
  /// Writes the file anew with one line an item.
  void compact();

 private:
  Json entry(const Item& item, const char* state) const;
  void append(const Json& line);

  std::string path_;
  std::string command_;
  mutable std::mutex mutex_;
  std::map<std::string, Json> items_;  ///< by their first file
};

}  // namespace azulejo::cli
