// What bench/large_files needs beside the command: the test files, and libvips' way through the same steps.
//   large_files_helper make WIDTH HEIGHT FILE    a picture, RGB of 8 bits; of FILE.tif tiles
//   large_files_helper chain SOURCE RESULT       grayscale, gaussian, sobel, threshold; on VIPS_CONCURRENCY threads
#include <cstdio>
#include <exception>
#include <string>
#include <vips/vips8>

#include "harness.h"

namespace {

using namespace azulejo;
using namespace azulejo::bench;

vips::VOption* writing(const std::string& path) {
  const bool tiff = path.ends_with(".tif");
  return tiff ? vips::VImage::option()->set("tile", true)->set("tile_width", 256)->set("tile_height", 256)
              : vips::VImage::option()->set("compression", 1);
}

void make(int width, int height, const std::string& path) {
  const ImageInfo info = photo(PixelType::U8, 3, {width, height});
  const auto image = make_photo(info);
  const AnyView rows{image->any().data, static_cast<std::ptrdiff_t>(info.row_bytes()), info};
  fill_photo(rows);
  vips::VImage::new_from_memory(rows.data, info.row_bytes() * static_cast<std::size_t>(height), width, height, 3,
                                VIPS_FORMAT_UCHAR)
      .copy(vips::VImage::option()->set("interpretation", VIPS_INTERPRETATION_sRGB))
      .write_to_file(path.c_str(), writing(path));
}

/// All steps in one pipeline, the file read from top to bottom; libvips' Sobel of bytes gives bytes.
void chain(const std::string& source, const std::string& result) {
  vips::VImage::new_from_file(source.c_str(), vips::VImage::option()->set("access", VIPS_ACCESS_SEQUENTIAL))
      .colourspace(VIPS_INTERPRETATION_B_W)
      .gaussblur(1.5)
      .sobel()
      .relational_const(VIPS_OPERATION_RELATIONAL_MORE, {127.0})
      .write_to_file(result.c_str(), writing(result));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (VIPS_INIT(arguments[0]) != 0) return 1;
    const std::string mode = count > 1 ? arguments[1] : "";
    if (mode == "make" && count == 5) {
      make(std::stoi(arguments[2]), std::stoi(arguments[3]), arguments[4]);
    } else if (mode == "chain" && count == 4) {
      chain(arguments[2], arguments[3]);
    } else {
      std::fprintf(stderr, "large_files_helper make WIDTH HEIGHT FILE | chain SOURCE RESULT\n");
      return 2;
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "large_files_helper: %s\n", error.what());
    return 1;
  }
}
