#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/image_io.h"
#include "azulejo/io/model_io.h"

namespace azulejo::cli {

/// What was asked for.
struct CommandLine {
  std::string command;  ///< "run", "ops", "info", "completion", "manual", "help", "version", an operation's name
  const Operation* operation = nullptr;  ///< where the command is one
  std::vector<std::string> positionals;
  std::vector<std::string> outputs;
  std::vector<std::pair<std::string, std::string>> arguments;  ///< of the operation, as written

  int threads = 0;
  bool help = false;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool strict = false;
  bool explain = false;
  bool force = false;
  bool tree = false;
  std::string stages;
  int frames = 0;          ///< of a sequence; 0: not asked for
  int views = 0;           ///< of a sequence; 0: not asked for
  std::uint64_t seed = 0;  ///< of views
  Limits limits;
  ReadOptions read;
  WriteOptions write;
  ModelReadOptions read_model;
  ModelWriteOptions write_model;

  std::vector<std::string> words;  ///< all of it, for a batch's manifest
};

/// An option that all commands share.
struct CommonOption {
  std::string name;        ///< "--threads"
  std::string short_name;  ///< "-t", or empty
  std::string argument;    ///< "N"; empty: a flag
  std::string help;
  std::vector<std::string> choices;
  std::function<void(const std::string& text)> set;
};

/// The shared options, bound to `line`: help, completion and the manual are made from this list too.
std::vector<CommonOption> common_options(CommandLine& line);

/// A command that is no operation.
struct Command {
  const char* name;
  const char* usage;
  const char* help;
};
const std::vector<Command>& commands();

/// "--border-value" for border_value.
std::string flag_of(const std::string& name);

/// Reads the command line. Throws Error(Argument), one line.
CommandLine parse_command_line(int count, const char* const* words);

}  // namespace azulejo::cli
