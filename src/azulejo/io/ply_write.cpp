#include "azulejo/io/ply_write.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/io/load_number.h"
#include "azulejo/io/write_chunks.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;  ///< rows that are put into bytes at once

/// Appends values to a row: bytes, or digits and blanks.
class RowWriter {
 public:
  RowWriter(std::string& text, bool ascii) : text_(text), ascii_(ascii) {}

  template <class T>
  void put(T value) {
    if (!ascii_) {
      std::array<std::byte, sizeof(T)> bytes;
      store_number(bytes.data(), value, std::endian::little);
      text_.append(reinterpret_cast<const char*>(bytes.data()), sizeof(T));
      return;
    }
    if (!std::exchange(first_, false)) text_ += ' ';
    if constexpr (sizeof(T) == 1) {
      append_number(text_, std::uint32_t{value});
    } else {
      append_number(text_, value);
    }
  }
  void end_row() {
    if (ascii_) text_ += '\n';
    first_ = true;
  }

 private:
  std::string& text_;
  bool ascii_;
  bool first_ = true;
};

template <class T>
constexpr const char* kTypeName = "float";
template <>
constexpr const char* kTypeName<std::uint8_t> = "uchar";
template <>
constexpr const char* kTypeName<std::uint32_t> = "uint";

/// An attribute's components as properties.
struct Columns {
  const Attribute* attribute;
  std::vector<std::string> names;
  bool turned = false;  ///< the second is 1 − its value
};

Columns columns_of(const Attribute& attribute) {
  const auto components = static_cast<std::size_t>(attribute.components);
  const std::vector<std::string> colors = {"red", "green", "blue", "alpha"};
  if (attribute.name == "NORMAL" && components == 3 && attribute.domain == Domain::Vertex) {
    return {&attribute, {"nx", "ny", "nz"}};
  }
  if (attribute.name == "COLOR_0" && components >= 3 && attribute.get<std::uint32_t>() == nullptr) {
    return {&attribute, {colors.begin(), colors.begin() + attribute.components}};
  }
  if (attribute.name == "TEXCOORD_0" && components == 2 && attribute.get<float>() != nullptr) {
    return {&attribute, {"s", "t"}, true};
  }
  Columns columns = {&attribute, {}};
  for (std::size_t i = 0; i < components; ++i) {
    columns.names.push_back(components == 1 ? attribute.name : fmt::format("{}_{}", attribute.name, i));
  }
  // A property is one word.
  for (std::string& name : columns.names) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c >= 0 && c <= ' '; }, '_');
  }
  return columns;
}

std::vector<Columns> columns_of(const Mesh& mesh, Domain domain) {
  std::vector<Columns> result;
  for (const Attribute& each : mesh.attributes) {
    if (each.domain == domain) result.push_back(columns_of(each));
  }
  return result;
}

void put_columns(RowWriter& writer, const std::vector<Columns>& columns, std::size_t row) {
  for (const Columns& each : columns) {
    std::visit(
        [&](const auto& values) {
          for (std::size_t i = 0; i < each.names.size(); ++i) {
            const auto value = values[row * each.names.size() + i];
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, float>) {
              writer.put(each.turned && i == 1 ? 1 - value : value);
            } else {
              writer.put(value);
            }
          }
        },
        each.attribute->values);
  }
}

std::string property_lines(const std::vector<Columns>& columns) {
  std::string text;
  for (const Columns& each : columns) {
    std::visit(
        [&]<class T>(const Array<T>&) {
          for (const std::string& name : each.names) text += fmt::format("property {} {}\n", kTypeName<T>, name);
        },
        each.attribute->values);
  }
  return text;
}

const Attribute* corner_texcoords(const Mesh& mesh) {
  for (const Attribute& each : mesh.attributes) {
    if (each.name == "TEXCOORD_0" && each.domain == Domain::Corner && each.components == 2 &&
        each.get<float>() != nullptr) {
      return &each;
    }
  }
  return nullptr;
}

class PlyWriter {
 public:
  PlyWriter(Output& output, const Mesh& mesh, bool ascii, const Run& run)
      : output_(output),
        mesh_(mesh),
        ascii_(ascii),
        run_(run),
        vertex_columns_(columns_of(mesh, Domain::Vertex)),
        face_columns_(columns_of(mesh, Domain::Face)),
        texcoords_(corner_texcoords(mesh)) {
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
      longest_ = std::max(longest_, mesh.face_end(face) - mesh.face_begin(face));
    }
  }

  void write() {
    warn_of_losses();
    write_text(output_, header());
    write_rows(mesh_.vertex_count(), [&](RowWriter& writer, std::size_t row) {
      for (int axis = 0; axis < 3; ++axis) writer.put(mesh_.positions[row][axis]);
      put_columns(writer, vertex_columns_, row);
    });
    write_rows(mesh_.face_count(), [&](RowWriter& writer, std::size_t row) { put_face(writer, row); });
    write_rows(mesh_.lines.size() / 2, [&](RowWriter& writer, std::size_t row) {
      for (std::size_t i = 0; i < 2; ++i) writer.put(mesh_.lines[row * 2 + i]);
    });
  }

 private:
  /// The length of lists takes a byte where it can; wedge coordinates are twice as many.
  bool short_lists() const { return longest_ * 2 <= 255; }

  std::string header() const {
    const char* const count = short_lists() ? "uchar" : "uint";
    std::string text = fmt::format("ply\nformat {} 1.0\ncomment azulejo\nelement vertex {}\n",
                                   ascii_ ? "ascii" : "binary_little_endian", mesh_.vertex_count());
    text += "property float x\nproperty float y\nproperty float z\n" + property_lines(vertex_columns_);
    if (mesh_.face_count() > 0) {
      text += fmt::format("element face {}\nproperty list {} uint vertex_indices\n", mesh_.face_count(), count);
      if (texcoords_ != nullptr) text += fmt::format("property list {} float texcoord\n", count);
      text += property_lines(face_columns_);
    }
    if (!mesh_.lines.empty()) {
      text += fmt::format("element edge {}\nproperty uint vertex1\nproperty uint vertex2\n", mesh_.lines.size() / 2);
    }
    return text + "end_header\n";
  }

  void put_count(RowWriter& writer, std::size_t count) const {
    short_lists() ? writer.put(static_cast<std::uint8_t>(count)) : writer.put(static_cast<std::uint32_t>(count));
  }

  void put_face(RowWriter& writer, std::size_t face) const {
    const std::size_t begin = mesh_.face_begin(face);
    const std::size_t end = mesh_.face_end(face);
    put_count(writer, end - begin);
    for (std::size_t corner = begin; corner < end; ++corner) writer.put(mesh_.corners[corner]);
    if (texcoords_ != nullptr) {
      const Array<float>& values = *texcoords_->get<float>();
      put_count(writer, 2 * (end - begin));
      for (std::size_t corner = begin; corner < end; ++corner) {
        writer.put(values[corner * 2]);
        writer.put(1 - values[corner * 2 + 1]);
      }
    }
    put_columns(writer, face_columns_, face);
  }

  void write_rows(std::size_t rows, const std::function<void(RowWriter&, std::size_t row)>& put) {
    write_in_chunks(output_, rows, kChunk, run_, [&](std::string& text, std::size_t begin, std::size_t end) {
      RowWriter writer(text, ascii_);
      for (std::size_t row = begin; row < end; ++row) {
        put(writer, row);
        writer.end_row();
      }
    });
  }

  void warn_of_losses() const {
    for (const Attribute& each : mesh_.attributes) {
      if (each.domain != Domain::Corner || &each == texcoords_) continue;
      warn(run_, fmt::format("{}: PLY holds no {} of corners; it is left out", output_.name(), each.name));
    }
    if (!mesh_.material.empty())
      warn(run_, fmt::format("{}: PLY holds no materials; they are left out", output_.name()));
    if (!mesh_.morph_targets.empty()) {
      warn(run_, fmt::format("{}: PLY holds no morph targets; they are left out", output_.name()));
    }
  }

  Output& output_;
  const Mesh& mesh_;
  bool ascii_;
  const Run& run_;
  std::vector<Columns> vertex_columns_;
  std::vector<Columns> face_columns_;
  const Attribute* texcoords_;
  std::size_t longest_ = 0;  ///< corners of a face
};

}  // namespace

void write_ply(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run) {
  PlyWriter(output, mesh, options.ascii, run).write();
}

}  // namespace azulejo
