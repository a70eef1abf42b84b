#pragma once

#include <string>

namespace azulejo::reference {

/// Text that stands for itself in Markdown, outside of backticks too.
std::string escaped(const std::string& text);

/// Whether a header declares a function of that name for all to use, with a comment above it.
bool tells_of(const std::string& header, const std::string& name);

/// What the header of an operation says to those who write C++: the comment of its function as prose and a table, the
/// rest as code.
/// header  its text
/// path    below src, as it is included
/// name    of the function
/// Throws  Error(Data) if it declares no such function, or that has no comment
std::string manual(const std::string& header, const std::string& path, const std::string& name);

}  // namespace azulejo::reference
