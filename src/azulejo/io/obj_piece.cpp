#include "azulejo/io/obj_piece.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/text_numbers.h"

namespace azulejo {
namespace {

constexpr std::size_t kUnknownKinds = 4;

bool ends_line(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Runs over a piece once. Every line ends in \n or \r before the text does, so inner loops need no other end.
class PieceParser {
 public:
  PieceParser(const ObjPlace& place, ObjPiece& piece, const ObjCounts* before, const ObjCounts* total)
      : piece_(piece),
        place_(place),
        before_(before),
        total_(total),
        at_(place.text.data()),
        end_(place.text.data() + place.text.size()) {}

  void parse();

 private:
  /// A kind of element that indices name.
  struct Named {
    const char* what;
    std::size_t here;  ///< in the piece so far
    std::size_t ObjCounts::*of_counts;
  };

  void statement();
  void other_statement(std::string_view keyword);
  void note_unknown(std::string_view keyword);
  void position();
  void texcoord();
  void normal();
  void face();
  void line();
  void points();
  void smoothing();
  ObjEvent& event(ObjEvent::Kind kind);

  void skip_blanks();
  void skip_line();
  void skip_comment();
  bool at_end_of_statement() const { return ends_line(*at_) || *at_ == '#'; }
  std::string_view word() const;
  std::string_view rest_of_line();
  std::size_t numbers(float* values, std::size_t most);
  float number();
  void odd_number(const char* begin);
  std::int32_t index(const Named& named);
  void check_index(const Named& named, std::int64_t index, std::string_view text) const;
  Named vertex() const { return {"vertex", piece_.positions.size(), &ObjCounts::vertices}; }
  Named texcoord_named() const { return {"texture coordinate", piece_.texcoords.size(), &ObjCounts::texcoords}; }
  Named normal_named() const { return {"normal", piece_.normals.size(), &ObjCounts::normals}; }
  std::uint64_t byte_of(const char* place) const {
    return place_.offset + static_cast<std::uint64_t>(place - place_.text.data());
  }
  Error error(const char* place, const std::string& what) const;

  ObjPiece& piece_;
  const ObjPlace& place_;
  const ObjCounts* before_;
  const ObjCounts* total_;
  const char* at_;
  const char* end_;
};

Error PieceParser::error(const char* place, const std::string& what) const {
  return place_.file.error(byte_of(place), what);
}

/// Also passes a \ at the end of a line, which goes on in the next.
void PieceParser::skip_blanks() {
  for (;;) {
    while (is_blank(*at_)) ++at_;
    if (*at_ != '\\') return;
    const char* next = at_ + 1;
    if (*next == '\r') ++next;
    if (*next == '\n') ++next;
    if (next == at_ + 1) return;
    at_ = next;
  }
}

/// To the end of the line, or of the last that it goes on in.
void PieceParser::skip_line() {
  for (;;) {
    while (!at_end_of_statement() && *at_ != '\\') ++at_;
    if (*at_ != '\\') return skip_comment();
    const char* const before = at_;
    skip_blanks();
    if (at_ == before) ++at_;
  }
}

/// A comment doesn't go on.
void PieceParser::skip_comment() {
  while (!ends_line(*at_)) ++at_;
}

std::string_view PieceParser::word() const {
  const char* end = at_;
  while (!is_blank(*end) && !ends_line(*end)) ++end;
  return {at_, static_cast<std::size_t>(end - at_)};
}

/// A name, which may hold blanks.
std::string_view PieceParser::rest_of_line() {
  skip_blanks();
  const char* const begin = at_;
  skip_comment();
  const char* end = at_;
  while (end > begin && is_blank(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

/// at_ stands behind a number, at more of the same word: that is passed.
void PieceParser::odd_number(const char* begin) {
  if (*at_ == '#') return;
  at_ += word().size();
  if (piece_.odd_numbers++ > 0) return;
  piece_.odd_number = quoted_word({begin, static_cast<std::size_t>(at_ - begin)});
  piece_.odd_number_at = byte_of(begin);
}

float PieceParser::number() {
  const char* const begin = at_;
  float value = 0;
  const char* const behind = parse_float(at_, value);
  if (behind == nullptr) throw error(begin, fmt::format("'{}', a number expected", quoted_word(word())));
  at_ = behind;
  if (!is_blank(*at_) && !ends_line(*at_) && *at_ != '\\') [[unlikely]]
    odd_number(begin);
  return value;
}

/// The numbers of the line, up to `most`; returns how many there were. The rest of the line is passed.
std::size_t PieceParser::numbers(float* values, std::size_t most) {
  std::size_t count = 0;
  for (skip_blanks(); !at_end_of_statement() && count < most; skip_blanks()) values[count++] = number();
  if (!ends_line(*at_)) skip_line();
  return count;
}

void PieceParser::position() {
  const char* const begin = at_;
  std::array<float, 6> values;
  const std::size_t count = numbers(values.data(), values.size());
  if (count < 3) throw error(begin, fmt::format("v has {} numbers, 3 expected", count));
  if (count == 6) {
    piece_.colors.resize(piece_.positions.size(), glm::vec3(1.0F));
    piece_.colors.emplace_back(values[3], values[4], values[5]);
  }
  piece_.positions.emplace_back(values[0], values[1], values[2]);
}

void PieceParser::texcoord() {
  const char* const begin = at_;
  std::array<float, 2> values = {0, 0};
  if (numbers(values.data(), values.size()) < 1) throw error(begin, "vt has no number, 1 to 3 expected");
  piece_.texcoords.emplace_back(values[0], values[1]);
}

void PieceParser::normal() {
  const char* const begin = at_;
  std::array<float, 3> values;
  const std::size_t count = numbers(values.data(), values.size());
  if (count < 3) throw error(begin, fmt::format("vn has {} numbers, 3 expected", count));
  piece_.normals.emplace_back(values[0], values[1], values[2]);
}

void PieceParser::check_index(const Named& named, std::int64_t index, std::string_view text) const {
  const auto count = static_cast<std::int64_t>(total_->*named.of_counts);
  if (index < 0 || index >= count) {
    throw error(text.data(), fmt::format("{} {}, of {}", named.what, quoted_word(text), count));
  }
}

/// Reads 1 … n, or −1 … −n for the last … the first so far.
std::int32_t PieceParser::index(const Named& named) {
  constexpr std::int32_t kMost = kObjRelative - 1;
  const char* const begin = at_;
  std::int64_t value = 0;
  const char* const behind = parse_integer(at_, value);
  if (behind == nullptr) {
    throw error(begin, fmt::format("'{}', the number of a {} expected", quoted_word(word()), named.what));
  }
  at_ = behind;
  if (total_ != nullptr) {
    if (value == 0) throw error(begin, fmt::format("{} 0: they count from 1", named.what));
    const auto before = static_cast<std::int64_t>(before_->*named.of_counts + named.here);
    check_index(named, value < 0 ? before + value : value - 1, {begin, static_cast<std::size_t>(at_ - begin)});
  }
  // 0 becomes one that is out of range: of several errors the first in the file is told.
  if (value == 0) return kMost;
  if (value > 0) return static_cast<std::int32_t>(std::min<std::int64_t>(value - 1, kMost));
  const std::int64_t relative = static_cast<std::int64_t>(named.here) + std::max<std::int64_t>(value, -kMost);
  return static_cast<std::int32_t>(relative - kObjRelative);
}

void PieceParser::face() {
  const std::size_t first = piece_.corners.size();
  for (skip_blanks(); !at_end_of_statement(); skip_blanks()) {
    const std::int32_t at_vertex = index(vertex());
    std::int32_t at_texcoord = kObjNone;
    std::int32_t at_normal = kObjNone;
    if (*at_ == '/') {
      ++at_;
      if (*at_ != '/' && !is_blank(*at_) && !ends_line(*at_)) at_texcoord = index(texcoord_named());
      if (*at_ == '/') {
        ++at_;
        if (!is_blank(*at_) && !ends_line(*at_)) at_normal = index(normal_named());
      }
    }
    if (!is_blank(*at_) && !ends_line(*at_) && *at_ != '\\' && *at_ != '#') {
      throw error(at_, fmt::format("'{}' behind a corner of a face", quoted_word(word())));
    }
    const std::size_t corner = piece_.corners.size();
    piece_.corners.push_back(at_vertex);
    if (at_texcoord != kObjNone || !piece_.corner_texcoords.empty()) {
      piece_.corner_texcoords.resize(corner, kObjNone);
      piece_.corner_texcoords.push_back(at_texcoord);
    }
    if (at_normal != kObjNone || !piece_.corner_normals.empty()) {
      piece_.corner_normals.resize(corner, kObjNone);
      piece_.corner_normals.push_back(at_normal);
    }
  }
  if (!ends_line(*at_)) skip_line();
  const std::size_t size = piece_.corners.size() - first;
  if (size < 3) {
    ++piece_.small_faces;
    piece_.corners.resize(first);
    if (piece_.corner_texcoords.size() > first) piece_.corner_texcoords.resize(first);
    if (piece_.corner_normals.size() > first) piece_.corner_normals.resize(first);
    return;
  }
  piece_.triangles = piece_.triangles && size == 3;
  piece_.face_sizes.push_back(static_cast<std::uint32_t>(size));
}

/// A polyline; texture coordinates along it are left out.
void PieceParser::line() {
  std::int32_t previous = kObjNone;
  for (skip_blanks(); !at_end_of_statement(); skip_blanks()) {
    const std::int32_t next = index(vertex());
    if (*at_ == '/') at_ += word().size();
    if (previous != kObjNone) {
      piece_.lines.push_back(previous);
      piece_.lines.push_back(next);
    }
    previous = next;
  }
  if (!ends_line(*at_)) skip_line();
}

void PieceParser::points() {
  for (skip_blanks(); !at_end_of_statement(); skip_blanks()) piece_.points.push_back(index(vertex()));
  if (!ends_line(*at_)) skip_line();
}

/// One that nothing stands between it and the last of its kind takes that one's place.
ObjEvent& PieceParser::event(ObjEvent::Kind kind) {
  ObjEvent next;
  next.kind = kind;
  next.vertices = piece_.positions.size();
  next.faces = piece_.face_sizes.size();
  next.line_ends = piece_.lines.size();
  next.points = piece_.points.size();
  if (!piece_.events.empty() && kind != ObjEvent::Kind::Library) {
    ObjEvent& last = piece_.events.back();
    if (last.kind == kind && last.vertices == next.vertices && last.faces == next.faces &&
        last.line_ends == next.line_ends && last.points == next.points) {
      return last = std::move(next);
    }
  }
  return piece_.events.emplace_back(std::move(next));
}

/// "off", "on" or a number; others are taken for 0.
void PieceParser::smoothing() {
  const std::string_view text = rest_of_line();
  std::uint32_t group = text == "on" ? 1 : 0;
  std::from_chars(text.data(), text.data() + text.size(), group);
  event(ObjEvent::Kind::Smoothing).smoothing = group;
}

void PieceParser::note_unknown(std::string_view keyword) {
  const std::string word = quoted_word(keyword);
  if (piece_.unknown.size() == kUnknownKinds ||
      std::find(piece_.unknown.begin(), piece_.unknown.end(), word) != piece_.unknown.end()) {
    return;
  }
  if (piece_.unknown.empty()) piece_.unknown_at = byte_of(keyword.data());
  piece_.unknown.push_back(word);
}

void PieceParser::other_statement(std::string_view keyword) {
  static constexpr std::array<std::string_view, 16> kCurves = {"vp",    "cstype", "deg",  "bmat", "step", "curv",
                                                               "curv2", "surf",   "parm", "trim", "hole", "scrv",
                                                               "sp",    "end",    "con",  "mg"};
  // How to display it, or about groups.
  static constexpr std::array<std::string_view, 11> kIgnored = {
      "g", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "usemap", "maplib", "ctech", "stech"};
  at_ += keyword.size();
  if (keyword == "o") {
    event(ObjEvent::Kind::Object).text = rest_of_line();
  } else if (keyword == "usemtl") {
    event(ObjEvent::Kind::Material).text = rest_of_line();
  } else if (keyword == "mtllib") {
    event(ObjEvent::Kind::Library).text = rest_of_line();
  } else if (keyword == "s") {
    smoothing();
  } else if (keyword == "l") {
    line();
  } else if (keyword == "p") {
    points();
  } else if (std::find(kCurves.begin(), kCurves.end(), keyword) != kCurves.end()) {
    ++piece_.curves;
    skip_line();
  } else {
    if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) note_unknown(keyword);
    skip_line();
  }
}

void PieceParser::statement() {
  const char first = at_[0];
  if (first == 'v' && is_blank(at_[1])) {
    at_ += 1;
    position();
  } else if (first == 'f' && (is_blank(at_[1]) || ends_line(at_[1]))) {
    at_ += 1;
    face();
  } else if (first == 'v' && at_[1] == 't' && is_blank(at_[2])) {
    at_ += 2;
    texcoord();
  } else if (first == 'v' && at_[1] == 'n' && is_blank(at_[2])) {
    at_ += 2;
    normal();
  } else if (first == '#') {
    skip_comment();
  } else {
    other_statement(word());
  }
}

void PieceParser::parse() {
  while (at_ < end_) {
    skip_blanks();
    if (!ends_line(*at_)) statement();
    while (at_ < end_ && ends_line(*at_)) ++at_;
  }
  if (!piece_.colors.empty()) piece_.colors.resize(piece_.positions.size(), glm::vec3(1.0F));
  if (!piece_.corner_texcoords.empty()) piece_.corner_texcoords.resize(piece_.corners.size(), kObjNone);
  if (!piece_.corner_normals.empty()) piece_.corner_normals.resize(piece_.corners.size(), kObjNone);
}

}  // namespace

ObjCounts ObjPiece::counts() const {
  return {positions.size(),  texcoords.size(), normals.size(), corners.size(),
          face_sizes.size(), lines.size(),     points.size()};
}

void parse_obj_piece(const ObjPlace& place, ObjPiece& piece, const ObjCounts* before, const ObjCounts* total) {
  PieceParser(place, piece, before, total).parse();
}

}  // namespace azulejo
