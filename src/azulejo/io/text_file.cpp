#include "azulejo/io/text_file.h"

#include "azulejo/io/output.h"

namespace azulejo {

void write_text_file(const std::string& path, std::string_view text) {
  const auto file = create_output(path);
  file->write(std::as_bytes(std::span(text)));
  file->commit();
}

}  // namespace azulejo
