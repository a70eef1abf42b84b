#pragma once

#include <string>
#include <vector>

#include "harness.h"

namespace azulejo::bench {

/// A line a number of threads, for a terminal.
std::string as_text(const Measured& row);
/// The geometric mean of the ratios, rows of parity left out, and what fell short.
std::string summary(const std::vector<Measured>& rows);
/// A table and the machine that it was measured on.
std::string as_markdown(const std::vector<Measured>& rows);
std::string as_json(const std::vector<Measured>& rows);

bool reached(const Measured& row);

/// Replaces what stands between the lines `<!-- NAME -->` and `<!-- /NAME -->` of a file. Throws Error if there is
/// no such place.
void replace_between_markers(const std::string& path, const std::string& name, const std::string& text);

}  // namespace azulejo::bench
