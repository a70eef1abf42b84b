#include <csignal>
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/text.h"
#include "azulejo/operations.h"
#include "command_line.h"
#include "help.h"
#include "info_command.h"
#include "run_command.h"

namespace azulejo::cli {
namespace {

/// Lives as long as the process: the signal handler looks at it.
const CancelToken& interrupted() {
  static const CancelToken token;
  return token;
}

void on_signal(int) { interrupted().cancel(); }

/// Interrupting stops between two tiles and leaves no half-written file; a second time it kills.
void listen() {
  interrupted();
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int show(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return std::fflush(stdout) == 0 ? 0 : 1;
}

int ops_command(const CommandLine& line) {
  if (line.positionals.size() > 1) throw Error(Error::Argument, "ops: expected at most one name");
  if (line.positionals.empty()) {
    if (!line.json) return show(operation_list());
    Json all = Json::array();
    for (const Operation* each : operations()) all.push(operation_json(*each));
    return show(Json::object().set("azulejo", AZULEJO_VERSION).set("operations", all).dump() + "\n");
  }
  const std::string& name = line.positionals[0];
  const Operation* const operation = find_operation(name);
  if (operation == nullptr) {
    std::vector<std::string> names;
    for (const Operation* each : operations()) names.push_back(each->name);
    throw Error(Error::Argument, fmt::format("ops: {}: no such operation{}", name, did_you_mean(name, names)));
  }
  return show(line.json ? operation_json(*operation).dump() + "\n" : operation_help(*operation));
}

int dispatch(const CommandLine& line) {
  if (line.command == "help") return show(help());
  if (line.command == "version") return show(fmt::format("azulejo {}\n", AZULEJO_VERSION));
  if (line.help && line.command == "turntable") return show(turntable_help());
  if (line.help) return show(line.operation != nullptr ? operation_help(*line.operation) : help());
  if (line.command == "ops") return ops_command(line);
  if (line.command == "info") return info_command(line);
  if (line.command == "manual") return show(manual());
  if (line.command == "completion") return show(completion(line.positionals.empty() ? "" : line.positionals[0]));
  return run_command(line, interrupted());
}

int exit_status(Error::Kind kind) {
  if (kind == Error::Argument) return 2;
  if (kind == Error::Cancelled) return 130;
  return 1;
}

}  // namespace
}  // namespace azulejo::cli

int main(int count, char** words) {
  using namespace azulejo;
  cli::listen();
  try {
    return cli::dispatch(cli::parse_command_line(count, words));
  } catch (const Error& error) {
    fmt::print(stderr, "azulejo: {}\n", error.what());
    return cli::exit_status(error.kind());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "azulejo: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "azulejo: {}\n", error.what());
  }
  return 1;
}
