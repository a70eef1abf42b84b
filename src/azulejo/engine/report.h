#pragma once

#include "azulejo/core/json.h"

namespace azulejo {

/// A result that is measured, not drawn: what a report says is JSON.
struct Report {
  Json json = Json::object();
  bool verdict = true;  ///< false: the command exits with status 3
};

}  // namespace azulejo
