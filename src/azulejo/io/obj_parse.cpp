#include "azulejo/io/obj_parse.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/obj_piece.h"

namespace azulejo {
namespace {

void warn_of_unknown(const std::vector<ObjPiece>& pieces, const ObjText& text, const Run& run) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> kinds;
  std::uint64_t at = 0;
  for (const ObjPiece& piece : pieces) {
    if (kinds.empty()) at = piece.unknown_at;
    for (const std::string& each : piece.unknown) {
      if (std::find(kinds.begin(), kinds.end(), each) == kinds.end()) kinds.push_back(each);
    }
  }
  if (kinds.empty()) return;
  const bool more = kinds.size() > kNamed;
  if (more) kinds.resize(kNamed);
  warn(run, fmt::format("{}: line {}: unknown statements are skipped: {}{}", text.name(), text.line_of(at),
                        fmt::join(kinds, ", "), more ? ", …" : ""));
}

void warn_of(const std::vector<ObjPiece>& pieces, const ObjText& text, const Run& run) {
  std::size_t curves = 0;
  std::size_t small_faces = 0;
  std::size_t odd_numbers = 0;
  const ObjPiece* odd = nullptr;
  for (const ObjPiece& piece : pieces) {
    curves += piece.curves;
    small_faces += piece.small_faces;
    odd_numbers += piece.odd_numbers;
    if (odd == nullptr && piece.odd_numbers > 0) odd = &piece;
  }
  warn_of_unknown(pieces, text, run);
  if (curves > 0) warn(run, fmt::format("{}: curves and surfaces are skipped: {} statements", text.name(), curves));
  if (small_faces > 0) {
    warn(run, fmt::format("{}: {} faces of fewer than three corners are left out", text.name(), small_faces));
  }
  if (odd != nullptr) {
    warn(run, fmt::format("{}: line {}: '{}' is no number, and read up to where it isn't; {} such", text.name(),
                          text.line_of(odd->odd_number_at), odd->odd_number, odd_numbers));
  }
}

/// Puts pieces together: where each begins is known when all are parsed.
class Merger {
 public:
  Merger(std::vector<ObjPiece>& pieces, const ObjText& text);
  ObjData merged(const Run& run);

 private:
  void allocate();
  void take(std::size_t piece);
  bool resolve(const Array<std::int32_t>& indices, std::size_t before, std::size_t count,
               std::uint32_t* resolved) const;
  void offsets(const ObjPiece& piece, const ObjCounts& before);
  void events();
  [[noreturn]] void throw_for(std::size_t piece) const;

  std::vector<ObjPiece>& pieces_;
  const ObjText& text_;
  std::vector<ObjCounts> before_;
  ObjCounts total_;
  ObjData data_;
  bool triangles_ = true;
  bool colors_ = false;
  bool texcoords_ = false;
  bool normals_ = false;
};

Merger::Merger(std::vector<ObjPiece>& pieces, const ObjText& text) : pieces_(pieces), text_(text) {
  for (const ObjPiece& piece : pieces_) {
    before_.push_back(total_);
    total_ += piece.counts();
    triangles_ = triangles_ && piece.triangles;
    colors_ = colors_ || !piece.colors.empty();
    texcoords_ = texcoords_ || !piece.corner_texcoords.empty();
    normals_ = normals_ || !piece.corner_normals.empty();
  }
  const std::size_t most = kObjRelative - 1;
  if (total_.vertices >= most || total_.texcoords >= most || total_.normals >= most || total_.corners >= 0xFFFFFFFE) {
    throw Error(Error::Unsupported, fmt::format("{}: {} vertices and {} corners, fewer than 2^30 and 2^32 are read",
                                                text.name(), total_.vertices, total_.corners));
  }
}

void Merger::allocate() {
  data_.faces = total_.faces;
  data_.positions.resize(total_.vertices);
  if (colors_) data_.colors.resize(total_.vertices);
  data_.texcoords.resize(total_.texcoords);
  data_.normals.resize(total_.normals);
  data_.corners.resize(total_.corners);
  if (texcoords_) data_.corner_texcoords.resize(total_.corners);
  if (normals_) data_.corner_normals.resize(total_.corners);
  if (!triangles_) data_.face_offsets.resize(total_.faces + 1);
  if (!triangles_) data_.face_offsets[0] = 0;
  data_.lines.resize(total_.line_ends);
  data_.points.resize(total_.points);
}

template <class T>
void copy_to(const Array<T>& source, Array<T>& result, std::size_t at) {
  std::copy(source.begin(), source.end(), result.begin() + static_cast<std::ptrdiff_t>(at));
}

/// False if an index names nothing; the result is undefined then.
bool Merger::resolve(const Array<std::int32_t>& indices, std::size_t before, std::size_t count,
                     std::uint32_t* resolved) const {
  const auto base = static_cast<std::int64_t>(before) + kObjRelative;
  bool good = true;
  for (const std::int32_t index : indices) {
    const std::int64_t absolute = index >= 0 ? index : index == kObjNone ? -1 : base + index;
    good = good && (index == kObjNone || static_cast<std::uint64_t>(absolute) < count);
    *resolved++ = static_cast<std::uint32_t>(absolute);
  }
  return good;
}

void Merger::offsets(const ObjPiece& piece, const ObjCounts& before) {
  if (triangles_) return;
  std::size_t corner = before.corners;
  std::uint32_t* offset = data_.face_offsets.data() + before.faces + 1;
  for (const std::uint32_t size : piece.face_sizes) {
    corner += size;
    *offset++ = static_cast<std::uint32_t>(corner);
  }
}

void Merger::take(std::size_t at) {
  ObjPiece& piece = pieces_[at];
  const ObjCounts& before = before_[at];
  copy_to(piece.positions, data_.positions, before.vertices);
  if (colors_) {
    piece.colors.resize(piece.positions.size(), glm::vec3(1.0F));
    copy_to(piece.colors, data_.colors, before.vertices);
  }
  copy_to(piece.texcoords, data_.texcoords, before.texcoords);
  copy_to(piece.normals, data_.normals, before.normals);
  offsets(piece, before);
  bool good = resolve(piece.corners, before.vertices, total_.vertices, data_.corners.data() + before.corners) &&
              resolve(piece.lines, before.vertices, total_.vertices, data_.lines.data() + before.line_ends) &&
              resolve(piece.points, before.vertices, total_.vertices, data_.points.data() + before.points);
  if (texcoords_) {
    piece.corner_texcoords.resize(piece.corners.size(), kObjNone);
    good = resolve(piece.corner_texcoords, before.texcoords, total_.texcoords,
                   data_.corner_texcoords.data() + before.corners) &&
           good;
  }
  if (normals_) {
    piece.corner_normals.resize(piece.corners.size(), kObjNone);
    good =
        resolve(piece.corner_normals, before.normals, total_.normals, data_.corner_normals.data() + before.corners) &&
        good;
  }
  if (!good) throw_for(at);
  // Only the events are wanted still.
  ObjPiece rest;
  rest.events = std::move(piece.events);
  piece = std::move(rest);
}

/// Parses the piece again, with all counts known: that throws, and says where.
void Merger::throw_for(std::size_t at) const {
  Array<char> buffer;
  ObjPiece again;
  parse_obj_piece({text_, text_.offset(at), text_.load(at, buffer)}, again, &before_[at], &total_);
  throw text_.error(text_.offset(at), "an index names nothing");
}

void Merger::events() {
  for (std::size_t at = 0; at < pieces_.size(); ++at) {
    for (ObjEvent& each : pieces_[at].events) {
      each.vertices += before_[at].vertices;
      each.faces += before_[at].faces;
      each.line_ends += before_[at].line_ends;
      each.points += before_[at].points;
      data_.events.push_back(std::move(each));
    }
  }
}

ObjData Merger::merged(const Run& run) {
  allocate();
  parallel_tasks(pieces_.size(), run, [&](std::size_t piece, int) { take(piece); });
  events();
  return std::move(data_);
}

}  // namespace

ObjCounts& ObjCounts::operator+=(const ObjCounts& other) {
  vertices += other.vertices;
  texcoords += other.texcoords;
  normals += other.normals;
  corners += other.corners;
  faces += other.faces;
  line_ends += other.line_ends;
  points += other.points;
  return *this;
}

ObjData parse_obj(const ObjText& text, const Run& run) {
  std::vector<ObjPiece> pieces(text.pieces());
  std::vector<Array<char>> buffers(static_cast<std::size_t>(thread_count(run)));
  parallel_tasks(pieces.size(), run, [&](std::size_t piece, int worker) {
    const std::string_view loaded = text.load(piece, buffers[static_cast<std::size_t>(worker)]);
    parse_obj_piece({text, text.offset(piece), loaded}, pieces[piece]);
  });
  buffers.clear();
  warn_of(pieces, text, run);
  return Merger(pieces, text).merged(run);
}

}  // namespace azulejo
