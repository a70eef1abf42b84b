#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// Reads the triangles of an STL file, text or binary, packed with gzip or not, as they stand there: three corners
/// each, nothing welded. The memory of `corners` is used again. Throws Error(Io | Data | Resource).
///
/// Cost  of 1 M triangles in binary: about that of copying the file from memory
AZULEJO_EXPORT void read_stl_soup(const std::string& path, Array<glm::vec3>& corners, const Run& run = {});

}  // namespace azulejo
