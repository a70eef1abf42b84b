#pragma once

#include <string>

#include "book.h"

namespace azulejo::reference {

/// Adds a guide page, `file` below docs, after running all that it shows, in the current folder:
/// - blocks marked sh are commands, all of which must succeed;
/// - blocks marked with a language and a name are files, which commands behind them read;
/// - blocks marked console have commands behind "$ ", and below each what it prints, which is written anew;
/// - a picture pictures/PAGE/NAME.webp, PAGE the page's own name, is made of the file NAME that a command wrote.
/// command  the program azulejo
void add_guide(Book& book, const std::string& file, const std::string& command);

}  // namespace azulejo::reference
