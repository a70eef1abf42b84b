#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace azulejo::cli {

/// The shared options that say how models are read and written, bound to `line`.
std::vector<CommonOption> model_options(CommandLine& line);

/// Reads WxHxD:type[:be][:skip=N][:spacing=x,y,z]. Throws Error(Argument).
RawVolume parse_raw_volume(const std::string& text);

}  // namespace azulejo::cli
