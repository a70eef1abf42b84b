#pragma once

#include <span>
#include <string>
#include <vector>

#include "book.h"

namespace azulejo::reference {

/// A picture that examples work on.
struct Sample {
  std::string name;   ///< of the file
  std::string what;   ///< what it shows
  std::string words;  ///< of the other samples that it is made of, as an example's; empty: it is rendered
  /// Below docs.
  std::string picture() const;
};

/// All there are; those that are made of others behind those.
std::span<const Sample> samples();
/// Those that the words of an example name, in that order, each once.
std::vector<Sample> samples_in(const std::string& words);

/// Writes the files into the current folder, and adds their pictures. Those that are rendered are, when the book is
/// made; to check it they are taken from the pictures that are there, so that the same values are measured whatever
/// processor this runs on.
/// painter  the program azulejos
void make_samples(Book& book, const std::string& painter);

}  // namespace azulejo::reference
