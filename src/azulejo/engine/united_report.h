#pragma once

#include <span>
#include <string>

#include "azulejo/engine/report.h"

namespace azulejo {

struct NamedReport {
  std::string name;
  const Report* report = nullptr;
};

/// The reports of several meshes as one: the sums of the numbers that they have, in the order in which these first
/// come, and "meshes": each report with the mesh's name. The verdict is yes where all are.
Report united(std::span<const NamedReport> reports);

}  // namespace azulejo
