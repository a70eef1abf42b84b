#include "azulejo/charting/font_data.h"

// The fonts' files, whose paths the build gives, are copied into the object by the assembler: neither generated sources
// nor megabytes for the compiler to read.
#define AZULEJO_EMBED(name, path)                                                  \
  asm(".pushsection .rodata,\"a\",%progbits\n"                                     \
      ".balign 16\n"                                                               \
      ".global " #name "_begin\n.hidden " #name "_begin\n" #name                   \
      "_begin:\n"                                                                  \
      ".incbin \"" path                                                            \
      "\"\n"                                                                       \
      ".global " #name "_end\n.hidden " #name "_end\n" #name                       \
      "_end:\n"                                                                    \
      ".byte 0\n"                                                                  \
      ".popsection\n");                                                            \
  extern "C" __attribute__((visibility("hidden"))) const std::byte name##_begin[]; \
  extern "C" __attribute__((visibility("hidden"))) const std::byte name##_end[]

AZULEJO_EMBED(azulejo_font_regular, AZULEJO_FONT_REGULAR);
AZULEJO_EMBED(azulejo_font_bold, AZULEJO_FONT_BOLD);

namespace azulejo {

std::span<const std::byte> font_data(bool bold) {
  return bold ? std::span(azulejo_font_bold_begin, azulejo_font_bold_end)
              : std::span(azulejo_font_regular_begin, azulejo_font_regular_end);
}

}  // namespace azulejo
