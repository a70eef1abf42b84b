#pragma once

#include "azulejo/data/view.h"
#include "azulejo/imaging/color_space_steps.h"

namespace azulejo::kernels {

/// The steps of `plan` for a tile of 3 channels, or of 4 whose last is copied. In place is allowed.
void color_space(const ConstAnyView& source, const AnyView& result, const ColorPlan& plan);

}  // namespace azulejo::kernels
