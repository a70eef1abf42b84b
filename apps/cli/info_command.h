#pragma once

#include "command_line.h"

namespace azulejo::cli {

/// Says what files hold, as text or JSON. Returns 0, or 1 if a file could not be read (the others are told).
int info_command(const CommandLine& line);

}  // namespace azulejo::cli
