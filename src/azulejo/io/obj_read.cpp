#include "azulejo/io/obj_read.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/data/no_material.h"
#include "azulejo/io/obj_build.h"
#include "azulejo/io/obj_materials.h"
#include "azulejo/io/obj_parse.h"

namespace azulejo {

Model read_obj(const ModelFile& file, const ModelReadOptions& options, const Run& run) {
  const std::string& name = file.input->name();
  ObjData data = parse_obj(ObjText(file.input, run), run);
  if (data.positions.empty()) throw Error(Error::Data, fmt::format("{}: there are no vertices", name));
  Scene scene;
  ObjMaterials materials(file, options, run, scene);
  for (const ObjEvent& event : data.events) {
    if (event.kind == ObjEvent::Kind::Library) materials.read_libraries(event.text);
  }
  const glm::vec4 unknown = data.colors.empty() ? kNoMaterialColor : glm::vec4(1.0F);
  std::vector<std::uint32_t> of_events(data.events.size(), MaterialId::kNone);
  for (std::size_t e = 0; e < data.events.size(); ++e) {
    if (data.events[e].kind == ObjEvent::Kind::Material) of_events[e] = materials.find(data.events[e].text, unknown);
  }
  build_obj(std::move(data), of_events, name, run, scene);
  return scene;
}

}  // namespace azulejo
