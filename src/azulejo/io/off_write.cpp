#include "azulejo/io/off_write.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include <fmt/format.h>

#include "azulejo/io/write_chunks.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;  ///< rows that are put into text at once

/// The attribute, if it is of a kind that OFF holds.
const Attribute* find_kind(const Mesh& mesh, std::string_view name, Domain domain, int least, int most) {
  for (const Attribute& each : mesh.attributes) {
    if (each.name == name && each.domain == domain && each.components >= least && each.components <= most) return &each;
  }
  return nullptr;
}

const Attribute* find_floats(const Mesh& mesh, std::string_view name, int components) {
  const Attribute* const found = find_kind(mesh, name, Domain::Vertex, components, components);
  return found != nullptr && found->get<float>() != nullptr ? found : nullptr;
}

const Attribute* find_colors(const Mesh& mesh, Domain domain) {
  const Attribute* const found = find_kind(mesh, "COLOR_0", domain, 3, 4);
  return found != nullptr && found->get<std::uint32_t>() == nullptr ? found : nullptr;
}

void append_floats(std::string& text, const Attribute& attribute, std::size_t element, bool turned) {
  const auto components = static_cast<std::size_t>(attribute.components);
  for (std::size_t i = 0; i < components; ++i) {
    const float value = (*attribute.get<float>())[element * components + i];
    text += ' ';
    append_number(text, turned && i == 1 ? 1 - value : value);
  }
}

/// 0–255, sRGB as the bytes are; floats are linear.
void append_color(std::string& text, const Attribute& attribute, std::size_t element) {
  const auto components = static_cast<std::size_t>(attribute.components);
  for (std::size_t i = 0; i < components; ++i) {
    const std::size_t at = element * components + i;
    std::uint32_t shade = 0;
    if (const Array<std::uint8_t>* const bytes = attribute.get<std::uint8_t>()) {
      shade = (*bytes)[at];
    } else {
      const float value = (*attribute.get<float>())[at];
      const float within = value > 0 ? std::min(value, 1.0F) : 0.0F;  // NaN: 0
      shade = static_cast<std::uint32_t>((i == 3 ? within : linear_to_srgb(within)) * 255 + 0.5F);
    }
    text += ' ';
    append_number(text, shade);
  }
}

void warn_of_losses(const Output& output, const Mesh& mesh, std::initializer_list<const Attribute*> kept,
                    const Run& run) {
  const auto lose = [&](const std::string& what) {
    warn(run, fmt::format("{}: OFF holds no {}; left out", output.name(), what));
  };
  for (const Attribute& each : mesh.attributes) {
    if (std::find(kept.begin(), kept.end(), &each) == kept.end()) {
      lose(fmt::format("attribute {} ({})", each.name, to_string(each.domain)));
    }
  }
  if (!mesh.lines.empty()) lose("lines");
  if (!mesh.material.empty()) lose("materials");
  if (!mesh.morph_targets.empty()) lose("morph targets");
}

}  // namespace

void write_off(Output& output, const Mesh& mesh, const ModelWriteOptions&, const Run& run) {
  const Attribute* const texcoords = find_floats(mesh, "TEXCOORD_0", 2);
  const Attribute* const colors = find_colors(mesh, Domain::Vertex);
  const Attribute* const normals = find_floats(mesh, "NORMAL", 3);
  const Attribute* const face_colors = find_colors(mesh, Domain::Face);
  warn_of_losses(output, mesh, {texcoords, colors, normals, face_colors}, run);
  write_text(output, fmt::format("{}{}{}OFF\n{} {} 0\n", texcoords != nullptr ? "ST" : "", colors != nullptr ? "C" : "",
                                 normals != nullptr ? "N" : "", mesh.vertex_count(), mesh.face_count()));
  write_in_chunks(output, mesh.vertex_count(), kChunk, run, [&](std::string& text, std::size_t begin, std::size_t end) {
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      for (int axis = 0; axis < 3; ++axis) {
        if (axis > 0) text += ' ';
        append_number(text, mesh.positions[vertex][axis]);
      }
      if (normals != nullptr) append_floats(text, *normals, vertex, false);
      if (colors != nullptr) append_color(text, *colors, vertex);
      if (texcoords != nullptr) append_floats(text, *texcoords, vertex, true);
      text += '\n';
    }
  });
  write_in_chunks(output, mesh.face_count(), kChunk, run, [&](std::string& text, std::size_t begin, std::size_t end) {
    for (std::size_t face = begin; face < end; ++face) {
      const std::size_t first = mesh.face_begin(face);
      const std::size_t last = mesh.face_end(face);
      append_number(text, static_cast<std::uint32_t>(last - first));
      for (std::size_t corner = first; corner < last; ++corner) {
        text += ' ';
        append_number(text, mesh.corners[corner]);
      }
      if (face_colors != nullptr) append_color(text, *face_colors, face);
      text += '\n';
    }
  });
}

}  // namespace azulejo
