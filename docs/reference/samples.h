#pragma once

#include <span>
#include <string>
#include <vector>

#include "book.h"

namespace azulejo::reference {

/// A picture, drawing, table or model that examples work on.
struct Sample {
  std::string name;        ///< of the file
  std::string what;        ///< what it shows
  std::string words = {};  ///< what makes it of other samples, as an example's; empty: it is rendered
  bool gray = false;       ///< of one that is rendered: one channel; WebP has three
  std::string text = {};   ///< of a drawing, a table or a model: the file
  /// Below docs.
  std::string picture() const;
  bool has_picture() const { return !name.ends_with(".csv"); }
  /// The words that make a picture of a drawing or a model.
  std::string drawn_by() const { return name.ends_with(".svg") ? " draw" : " render:width=240,height=240"; }
};

/// All there are; those that are made of others behind those.
std::span<const Sample> samples();
/// Those that the words of an example name, in that order, each once.
std::vector<Sample> samples_in(const std::string& words);

/// Writes the files into the current folder, and adds their pictures. Rendered is only to make the book; to check it the
/// pictures that are there are taken, so that the same is measured on whatever processor this runs.
/// painter  the program azulejos
void make_samples(Book& book, const std::string& painter);

}  // namespace azulejo::reference
