#pragma once

#include <string>

#include "azulejo/engine/operation.h"
#include "book.h"

namespace azulejo::reference {

/// Adds operations/NAME.md with its pictures; the examples are run in the current folder.
/// source  the folder of the project, for the header
void add_page(Book& book, const Operation& operation, const std::string& source);

/// Adds operations/README.md.
void add_index(Book& book);

}  // namespace azulejo::reference
