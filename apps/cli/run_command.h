#pragma once

#include "azulejo/core/run.h"
#include "azulejo/pipeline.h"
#include "command_line.h"

namespace azulejo::cli {

/// What an operation or a chain would compute, without its outputs. Throws Error as the command would.
Pipeline chain_of(const CommandLine& line, const Run& run);

/// Runs an operation or a chain, on one input or as a batch. Returns the exit status: 0, 1 if an item of a batch
/// failed, 3 if a report's verdict is no. Throws Error.
int run_command(const CommandLine& line, const CancelToken& cancel);

}  // namespace azulejo::cli
