#include "azulejo/modelling/ear_clipping.h"

namespace azulejo {
namespace {

constexpr std::int64_t kWorkPerCorner = 1024;  // random stars, combs and spirals of 10⁵ corners stay far below

}  // namespace

bool EarClipping::convex(std::uint32_t at) const {
  return turn((*points_)[previous_[at]], (*points_)[at], (*points_)[next_[at]]) > 0;
}

bool EarClipping::doubled(std::uint32_t at) const {
  const PlanePoint& before = (*points_)[previous_[at]];
  const PlanePoint& after = (*points_)[next_[at]];
  return before == (*points_)[at] || after == (*points_)[at] || before == after;
}

void EarClipping::link() {
  const std::size_t count = points_->size();
  remaining_ = static_cast<std::uint32_t>(count);
  here_ = 0;
  previous_.resize(count);
  next_.resize(count);
  for (std::uint32_t i = 0; i < remaining_; ++i) {
    previous_[i] = i == 0 ? remaining_ - 1 : i - 1;
    next_[i] = i + 1 == remaining_ ? 0 : i + 1;
  }
  marks_.assign(count, kQueued);
  queue_.resize(count);
  queue_front_ = 0;
  for (std::uint32_t i = 0; i < remaining_; ++i) queue_[i] = i;
  std::vector<std::uint32_t> held;
  for (std::uint32_t i = 0; i < remaining_; ++i) {
    if (!convex(i)) held.push_back(i);
  }
  blockers_.build(*points_, held);
}

bool EarClipping::blocked(std::uint32_t at, bool touching_blocks) {
  const PlanePoint ear[3] = {(*points_)[previous_[at]], (*points_)[at], (*points_)[next_[at]]};
  const PlanePoint& a = ear[0];
  const PlanePoint& b = ear[1];
  const PlanePoint& c = ear[2];
  return blockers_.any_near(ear, work_, [&](std::uint32_t point) {
    // A point where the ear has a corner is that corner, or belongs to a bridge or a ring that touches: what hangs on it
    // lies outside the ear, or has another point in it.
    const PlanePoint& p = (*points_)[point];
    if (p == a || p == b || p == c) return false;
    const double ab = turn(a, b, p);
    const double bc = turn(b, c, p);
    const double ca = turn(c, a, p);
    return touching_blocks ? ab >= 0 && bc >= 0 && ca >= 0 : ab > 0 && bc > 0 && ca > 0;
  });
}

bool EarClipping::may_cut(std::uint32_t at, Rule rule) {
  --work_;
  const double area = turn((*points_)[previous_[at]], (*points_)[at], (*points_)[next_[at]]);
  switch (rule) {
    case Rule::Ear: return area > 0 && !blocked(at, true);
    case Rule::Loose: return area >= 0 && !blocked(at, false);
    case Rule::Convex: return area > 0;
    case Rule::Any: return true;
  }
  return true;
}

void EarClipping::changed(std::uint32_t at) {
  if (blockers_.holds(at) && convex(at)) blockers_.remove(at);
  if ((marks_[at] & kQueued) == 0) queue_.push_back(at);
  marks_[at] = kQueued | kChanged;
}

void EarClipping::cut_off(std::uint32_t at) {
  const std::uint32_t before = previous_[at];
  const std::uint32_t after = next_[at];
  for (const std::uint32_t corner : {before, at, after}) *out_++ = corner;
  next_[before] = after;
  previous_[after] = before;
  marks_[at] |= kGone;
  blockers_.remove(at);
  --remaining_;
  here_ = after;
  changed(before);
  changed(after);
}

/// Cuts off corners that lie on a neighbour, and the tips of whiskers, until there are none. Whether there were any.
bool EarClipping::cut_doubled() {
  bool any = false;
  for (std::uint32_t tried = 0; tried < remaining_ && remaining_ > 3 && work_ > 0; ++tried, --work_) {
    if (doubled(here_)) {
      cut_off(here_);
      here_ = previous_[here_];  // may be doubled now
      tried = 0;
      any = true;
    } else {
      here_ = next_[here_];
    }
  }
  return any;
}

void EarClipping::cut_from_queue() {
  const std::uint32_t at = queue_[queue_front_++];
  if ((marks_[at] & kGone) != 0) return;
  if ((marks_[at] & kChanged) != 0) {
    // Others first: to cut on where the last cut was would make a fan of slivers.
    marks_[at] = kQueued;
    queue_.push_back(at);
    return;
  }
  marks_[at] = 0;
  if (may_cut(at, Rule::Ear)) cut_off(at);
}

void EarClipping::cut_by_laxer_rules() {
  for (const Rule rule : {Rule::Ear, Rule::Loose, Rule::Convex, Rule::Any}) {
    for (std::uint32_t tried = 0; tried < remaining_ && work_ > 0; ++tried, here_ = next_[here_]) {
      if (may_cut(here_, rule)) return cut_off(here_);
    }
  }
}

void EarClipping::cut_fan() {
  while (remaining_ > 2) {
    const std::uint32_t apex = previous_[here_];
    cut_off(here_);
    here_ = next_[apex];
  }
}

void EarClipping::cut(const std::vector<PlanePoint>& points, std::uint32_t* triangles) {
  points_ = &points;
  out_ = triangles;
  work_ = kWorkPerCorner * static_cast<std::int64_t>(points.size());
  link();
  cut_doubled();
  while (remaining_ > 3 && work_ > 0) {
    if (queue_front_ < queue_.size()) {
      cut_from_queue();
    } else if (!cut_doubled()) {
      cut_by_laxer_rules();
    }
  }
  cut_fan();
}

}  // namespace azulejo
