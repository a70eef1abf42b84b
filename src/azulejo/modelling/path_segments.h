#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "azulejo/data/drawing.h"

namespace azulejo {

/// A quadratic or cubic Bézier curve.
struct CurveSegment {
  std::array<glm::vec2, 4> points;  ///< order + 1 of them
  std::size_t order = 2;
};

inline bool finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// Goes through the runs of a transformed path: segments that hang together, which is a subpath where all of it is finite.
/// Segments with a coordinate that is not finite are left out, and so is a Move that nothing follows.
///
/// A curve with coordinates beyond 1e18 becomes its chord.
///
/// Sink:  void begin(const glm::vec2& point, bool closes)                 a run begins; closes: `end` will say closed, if
///                                                                       all that follows is finite
///        void lines(const glm::vec2* points, std::size_t count)          count ≥ 1 lines from the last point
///        void curve(const CurveSegment& curve)                           its first point is the last point
///        void end(bool closed)                                           closed: the last point is the first
template <class Sink>
class PathWalk {
 public:
  PathWalk(const PathView& path, const glm::mat3x2& picture_from_path, Sink& sink)
      : path_(path), picture_from_path_(picture_from_path), sink_(sink) {}

  void run() {
    std::size_t at = 0;
    for (std::size_t c = 0; c < path_.commands.size();) {
      const PathCommand command = path_.commands[c];
      command_ = c;
      std::size_t count = 1;
      if (command == PathCommand::Move) {
        move(point(at));
      } else if (command == PathCommand::Close) {
        close();
      } else if (command == PathCommand::Line) {
        while (c + count < path_.commands.size() && path_.commands[c + count] == PathCommand::Line) ++count;
        lines(at, count);
      } else {
        curve(at, points_of(command));
      }
      at += command == PathCommand::Line ? count : points_of(command);
      c += count;
    }
    end(false);
  }

 private:
  static constexpr std::size_t kChunk = 256;
  static constexpr float kFar = 1e18F;  ///< squares of coordinates stay finite below

  glm::vec2 point(std::size_t at) const { return transformed(picture_from_path_, path_.points[at]); }

  void move(const glm::vec2& point) {
    end(false);
    start_ = here_ = point;
    whole_ = moved_ = true;
  }

  void begin() {
    if (running_) return;
    sink_.begin(here_, whole_ && closes());
    running_ = true;
    moved_ = false;
  }

  /// Whether Close comes before the next Move: looked for once a subpath.
  bool closes() const {
    for (std::size_t c = command_; c < path_.commands.size(); ++c) {
      if (path_.commands[c] == PathCommand::Move) return false;
      if (path_.commands[c] == PathCommand::Close) return true;
    }
    return false;
  }

  void end(bool closed) {
    if (running_) sink_.end(closed);
    running_ = false;
  }

  void close() {
    if ((running_ || moved_) && finite(here_) && finite(start_)) {
      begin();
      if (here_ != start_) sink_.lines(&start_, 1);
      end(whole_);
    }
    end(false);
    here_ = start_;
    whole_ = true;
    moved_ = false;
  }

  void to(const glm::vec2& point, bool all_finite) {
    if (!all_finite) {
      end(false);
      whole_ = moved_ = false;
    }
    here_ = point;
  }

  void lines(std::size_t first, std::size_t count) {
    std::array<glm::vec2, kChunk> chunk;
    for (std::size_t done = 0; done < count; done += kChunk) {
      const std::size_t n = std::min(kChunk, count - done);
      bool all_finite = finite(here_);
      for (std::size_t i = 0; i < n; ++i) {
        chunk[i] = point(first + done + i);
        all_finite &= std::abs(chunk[i].x) <= std::numeric_limits<float>::max();
        all_finite &= std::abs(chunk[i].y) <= std::numeric_limits<float>::max();
      }
      if (all_finite) {
        begin();
        sink_.lines(chunk.data(), n);
        here_ = chunk[n - 1];
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        const bool line_finite = finite(here_) && finite(chunk[i]);
        if (line_finite) {
          begin();
          sink_.lines(&chunk[i], 1);
        }
        to(chunk[i], line_finite);
      }
    }
  }

  void curve(std::size_t first, std::size_t order) {
    CurveSegment curve{{here_}, order};
    float largest = std::max(std::abs(here_.x), std::abs(here_.y));
    bool all_finite = finite(here_);
    for (std::size_t i = 1; i <= order; ++i) {
      curve.points[i] = point(first + i - 1);
      all_finite = all_finite && finite(curve.points[i]);
      largest = std::max({largest, std::abs(curve.points[i].x), std::abs(curve.points[i].y)});
    }
    if (all_finite) {
      begin();
      if (largest < kFar) {
        sink_.curve(curve);
      } else {
        sink_.lines(&curve.points[order], 1);
      }
    }
    to(curve.points[order], all_finite);
  }

  const PathView& path_;
  const glm::mat3x2& picture_from_path_;
  Sink& sink_;
  std::size_t command_ = 0;
  glm::vec2 here_{0};
  glm::vec2 start_{0};
  bool running_ = false;
  bool whole_ = true;   ///< the run began where the subpath did
  bool moved_ = false;  ///< to here, and nothing followed
};

template <class Sink>
void walk_segments(const PathView& path, const glm::mat3x2& picture_from_path, Sink& sink) {
  PathWalk<Sink>(path, picture_from_path, sink).run();
}

}  // namespace azulejo
