#pragma once

#include "azulejo/io/model_codec.h"

namespace azulejo {

/// As obj.h says. Throws Error(Data) with the line, Error(Resource), Error(Unsupported).
Model read_obj(const ModelFile& file, const ModelReadOptions& options, const Run& run);

}  // namespace azulejo
