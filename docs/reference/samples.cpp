#include "samples.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "azulejo/core/error.h"
#include "azulejo/imaging/grayscale.h"
#include "azulejo/io/image_io.h"
#include "azulejo/operations.h"
#include "example.h"
#include "still_life.h"
#include "tile_drawing.h"

namespace azulejo::reference {

std::string Sample::picture() const {
  return "operations/pictures/sample-" + name.substr(0, name.rfind('.')) + ".webp";
}

std::span<const Sample> samples() {
  static const std::vector<Sample> list{
      {"photo.png", "a still life: RGB, 480×320"},
      {"later.png", "the same table a moment later"},
      {"other.png", "another picture of that size"},
      {"cutout.png", "the teapot on nothing: RGB with alpha"},
      {"mask.png", "white where the teapot is in photo.png, gray at its edges", "", true},
      {"labels.png",
       "what is seen in photo.png: 40 teapot, 80 orange, 120 lime, 160 lemon, 200 cube, 240 ball, 0 the rest", "",
       true},
      {"gray.png", "gray", "photo.png grayscale"},
      {"dark.png", "under-exposed, of low contrast",
       "photo.png exposure:stops=-2 brightness_contrast:brightness=-0.12,contrast=0.7"},
      {"noisy.png", "gray, with noise of both kinds", "gray.png noise:amount=0.04 noise:kind=salt_pepper,amount=0.04"},
      {"tiles.svg", "a drawing: painted tiles, 320×240", "", false, tile_drawing()},
      {"star.svg", "a star whose line crosses itself", "", false,
       R"(<svg xmlns="http://www.w3.org/2000/svg" width="240" height="240"><path fill="#e0912f" )"
       R"(d="M120 20 178.8 200.9 24.9 89.1H215.1L61.2 200.9Z"/></svg>)"},
      {"disk.svg", "a round page mark", "", false,
       R"(<svg xmlns="http://www.w3.org/2000/svg" width="240" height="240">)"
       R"(<circle cx="150" cy="130" r="60" fill="#1c5a8c"/></svg>)"},
      {"sights.csv", "what is seen in photo.png: `x,y,text,value` and three rows: fruit, and what it weighs", "", false,
       "x,y,text,value\n216,236,lemon,120\n328,209,orange,190\n446,222,lime,70\n"},
      {"gem.off",
       "a cut stone with faults: a facet is missing, one is inside out, there are a fin, a crack and a lost vertex", "",
       false,
       "OFF\n28 33 0\n1 0 0.15\n0.707 0.707 0.15\n0 1 0.15\n-0.707 0.707 0.15\n-1 0 0.15\n"
       "-0.707 -0.707 0.15\n-0 -1 0.15\n0.707 -0.707 0.15\n1 0 -0.05\n0.707 0.707 -0.05\n0 1 -0.05\n"
       "-0.707 0.707 -0.05\n-1 0 -0.05\n-0.707 -0.707 -0.05\n-0 -1 -0.05\n0.707 -0.707 -0.05\n"
       "0.554 0.23 0.5\n0.23 0.554 0.5\n-0.23 0.554 0.5\n-0.554 0.23 0.5\n-0.554 -0.23 0.5\n"
       "-0.23 -0.554 0.5\n0.23 -0.554 0.5\n0.554 -0.23 0.5\n0 0 -0.9\n1 0 -0.05\n1.15 -1.15 0.4\n"
       "0 0 1.1\n4 8 9 1 0\n3 0 1 16\n3 16 1 17\n3 24 9 8\n4 9 10 2 1\n3 17 2 18\n3 24 10 9\n"
       "4 10 11 3 2\n3 2 3 18\n3 18 3 19\n3 24 11 10\n4 11 12 4 3\n3 3 4 19\n3 19 4 20\n3 24 12 11\n"
       "4 12 13 5 4\n3 4 5 20\n3 20 5 21\n3 24 13 12\n4 13 14 6 5\n3 5 6 21\n3 21 6 22\n3 24 14 13\n"
       "4 14 15 7 6\n3 6 7 22\n3 23 7 22\n3 24 15 14\n4 15 8 0 7\n3 7 0 23\n3 23 0 16\n3 24 25 15\n"
       "8 16 17 18 19 20 21 22 23\n3 6 7 26\n"},
  };
  return list;
}

std::vector<Sample> samples_in(const std::string& words) {
  std::vector<std::pair<std::size_t, const Sample*>> found;
  for (const Sample& sample : samples()) {
    // Behind a letter it is the end of another name.
    std::size_t at = words.find(sample.name);
    while (at != std::string::npos && at > 0 && std::isalnum(static_cast<unsigned char>(words[at - 1])) != 0)
      at = words.find(sample.name, at + 1);
    if (at != std::string::npos) found.emplace_back(at, &sample);
  }
  std::sort(found.begin(), found.end());
  std::vector<Sample> in_order;
  for (const auto& [at, sample] : found) in_order.push_back(*sample);
  return in_order;
}

void make_samples(Book& book, const std::string& painter) {
  StillLife still_life;
  if (book.make()) still_life = paint_still_life(painter);
  for (const Sample& sample : samples()) {
    if (!sample.text.empty()) {
      std::ofstream(sample.name, std::ios::binary) << sample.text;
      if (sample.has_picture())
        book.add_picture(sample.picture(), shown(computed(sample.name + sample.drawn_by())).image);
      continue;
    }
    if (!sample.words.empty()) {
      const Value value = computed(sample.words);
      write_image(*value.image(), sample.name);
      book.add_picture(sample.picture(), *value.image());
      continue;
    }
    if (book.make()) book.add_picture(sample.picture(), still_life.at(sample.name), true);
    const Image image = book.make() ? read_image(book.picture(sample.picture()), sample.name)
                                    : read_image(book.docs() + "/" + sample.picture());
    write_image(sample.gray ? grayscale(image) : image.clone(), sample.name);
    if (!book.make()) book.add_picture(sample.picture(), image, true);
  }
}

}  // namespace azulejo::reference
