#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "azulejo/io/input.h"

namespace azulejo {

/// Whether the file begins like gzip: 1F 8B.
bool is_gzip(const Input& input);

/// What is packed in `input`, held in memory under the same name; several packed parts make one file.
/// Throws Error(Data) naming the byte where it is damaged or cut, Error(Resource) above `limit` bytes.
std::shared_ptr<const Input> unpack_gzip(const Input& input, std::int64_t limit);

/// Up to `count` bytes from its beginning; fewer where it is damaged.
std::vector<std::byte> unpack_gzip_head(const Input& input, std::size_t count);

}  // namespace azulejo
