#include "docent/planning/pursuit/detour_watch.h"

#include <algorithm>
#include <limits>

namespace docent::planning {
namespace {

struct Nearest {
  std::size_t index = 0;
  double away = std::numeric_limits<double>::infinity();  ///< [m]
};

Nearest nearest_on(const MeasuredWay& way, Point2 point, std::size_t from) {
  Nearest best;
  for (std::size_t i = from; i < way.points.size(); ++i) {
    const double away = distance(way.points[i], point);
    if (away < best.away) best = {i, away};
  }
  return best;
}

}  // namespace

Result<void> DetourParams::validate() const {
  if (!(corridor > 0.0)) return fail("detour.corridor must be > 0");
  if (!(back_within > 0.0)) return fail("detour.back_within must be > 0");
  if (!(local_extra >= 0.0)) return fail("detour.local_extra must be >= 0");
  if (!(lasts >= 0.0)) return fail("detour.lasts must be >= 0");
  return {};
}

MeasuredWay::MeasuredWay(std::span<const Point2> way) : points{way.begin(), way.end()} {
  along.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    along.push_back(i == 0 ? 0.0 : along.back() + distance(points[i - 1], points[i]));
  }
}

DetourWatch::Judgement DetourWatch::judge(const MeasuredWay& way) const {
  // Where the new way leaves the meant one, for the first time ...
  std::size_t leaves = 0;
  Nearest left = nearest_on(meant_, way.points.front(), 0);
  Nearest at = left;
  while (leaves < way.points.size()) {
    at = nearest_on(meant_, way.points[leaves], 0);
    if (at.away > params_.corridor) break;
    left = at;
    ++leaves;
  }
  const double meant_rest = meant_.length() - meant_.along[left.index];
  const double extra = way.length() - (leaves > 0 ? way.along[leaves - 1] : 0.0) - meant_rest;
  if (leaves == way.points.size()) return {};
  // ... and whether it is back soon, farther on.
  const double from = way.along[leaves];
  for (std::size_t i = leaves + 1; i < way.points.size() && way.along[i] - from <= params_.back_within; ++i) {
    const Nearest back = nearest_on(meant_, way.points[i], left.index);
    if (back.away > 0.5 * params_.corridor) continue;
    const double longer = way.along[i] - from - (meant_.along[back.index] - meant_.along[left.index]);
    if (longer <= params_.local_extra) return {Detour::local, std::max(0.0, longer)};
  }
  return {Detour::global, extra};
}

Detour DetourWatch::update(std::span<const Point2> way, Time now) {
  if (way.empty()) return change_;
  MeasuredWay measured{way};
  if (meant_.points.empty()) {
    meant_ = std::move(measured);
    seen_since_ = now;
    return change_;
  }
  const Judgement judgement = judge(measured);
  if (judgement.change != seen_) {
    seen_ = judgement.change;
    seen_since_ = now;
  }
  if (now - seen_since_ < seconds(params_.lasts)) return change_;
  change_ = seen_;
  extra_ = judgement.extra;
  if (change_ != Detour::local) meant_ = std::move(measured);
  return change_;
}

}  // namespace docent::planning
