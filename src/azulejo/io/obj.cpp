#include "azulejo/io/obj.h"

#include "azulejo/io/decode_pass.h"
#include "azulejo/io/obj_read.h"
#include "azulejo/io/obj_write.h"

namespace azulejo {
namespace {

/// OBJ has no signature: its ending tells.
bool matches(std::span<const std::byte>, std::uint64_t, std::string_view name) {
  return ending_of(std::string(name)) == "obj";
}

}  // namespace

const ModelCodec kObj = {"obj", {"obj"}, matches, read_obj, nullptr, write_obj};

}  // namespace azulejo
