#pragma once

#include <string>
#include <utility>
#include <vector>

#include "azulejo/core/run.h"
#include "command_line.h"

namespace azulejo::cli {

/// True if several pictures of one model are asked for: turntable, --frames, --views, or {frame} in an output.
bool is_sequence(const CommandLine& line);

/// `{frame}` and `{frame:04}` replaced by the number. Throws Error(Argument) for another form.
std::string with_frame(const std::string& output, int frame);

/// The operation's arguments; where an output is named as one of its `layers`, that is among them.
std::vector<std::pair<std::string, std::string>> arguments_with_layers(const CommandLine& line);

/// Pictures of each input: around it (turntable; --frames of a model that doesn't move), through its animation
/// (--frames), or from directions all over the sphere (--views, --seed). The model is read and made ready once; frames
/// that are done already are left out. Returns the exit status.
int sequence_command(const CommandLine& line, const CancelToken& cancel);

}  // namespace azulejo::cli
