#include "docent/simulator/sensing/camera/ceiling/ceiling_light.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kCell = 0.5;         // [m]
constexpr float kUsual = 0.8F;        // mean with all lamps on by day
constexpr float kFromOutside = 0.2F;  // of it, by day, everywhere
constexpr float kNever = 0.06F;       // of it, what is there at night without a lamp

}  // namespace

CeilingLight::CeilingLight(const Ceiling& ceiling, Point2 low, Point2 high)
    : low_{low},
      columns_{static_cast<int>(std::ceil((high.x - low.x) / kCell)) + 1},
      rows_{static_cast<int>(std::ceil((high.y - low.y) / kCell)) + 1} {
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  day_.assign(cells, 0.0F);
  for (auto& circuit : circuits_) circuit.assign(cells, 0.0F);
  if (ceiling.is_even) {
    for (auto& circuit : circuits_) circuit.assign(cells, 1.0F);
  } else {
    for (const Lamp& lamp : ceiling.lamps) {
      if (lamp.is_dead) continue;
      auto& circuit = circuits_[static_cast<std::size_t>(lamp.circuit)];
      const double strength = lamp.radiance * (lamp.kind == LampKind::downlight ? 0.25 : 1.0);
      add_bell(circuit, lamp.pose.position(), 2.4, strength);
      if (lamp.ceiling - lamp.height > 0.1) add_bell(circuit, lamp.pose.position(), 0.9, strength);
    }
    for (const CeilingField& field : ceiling.fields)
      if (field.covering == Covering::glazing) add_bell(day_, field.to_world({field.length, field.width}), 2.0, 3.0);
  }
  double sum = 0.0, most = 0.0;
  for (std::size_t i = 0; i < cells; ++i) {
    double here = day_[i];
    for (const auto& circuit : circuits_) here += circuit[i];
    sum += here > 0.0 ? here : 0.0;
    most += here > 0.0 ? 1.0 : 0.0;
  }
  const auto scale = sum > 0.0 ? static_cast<float>((1.0 - kFromOutside - kNever) * kUsual * most / sum) : 0.0F;
  for (auto& circuit : circuits_)
    for (float& cell : circuit) cell *= scale;
  for (float& cell : day_) cell = scale * cell + kFromOutside * kUsual;
  usual_ = field({}).now_;
}

void CeilingLight::add_bell(std::vector<float>& cells, Point2 at, double reach, double peak) const {
  const auto from = [&](double x, double first) {
    return std::max(0, static_cast<int>((x - first - 3.0 * reach) / kCell));
  };
  const auto to = [&](double x, double first, int most) {
    return std::min(most - 1, static_cast<int>((x - first + 3.0 * reach) / kCell));
  };
  for (int row = from(at.y, low_.y); row <= to(at.y, low_.y, rows_); ++row)
    for (int column = from(at.x, low_.x); column <= to(at.x, low_.x, columns_); ++column) {
      const Point2 off = low_ + kCell * Point2{static_cast<double>(column), static_cast<double>(row)} - at;
      cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)] +=
          static_cast<float>(peak * std::exp(-dot(off, off) / (2.0 * reach * reach)));
    }
}

CeilingLight::Field CeilingLight::field(const Lighting& lighting) const {
  Field made;
  made.x_ = static_cast<float>(low_.x), made.y_ = static_cast<float>(low_.y);
  made.columns_ = columns_, made.rows_ = rows_;
  made.lighting_ = lighting;
  made.usual_ = &usual_;
  made.is_usual_ = lighting.daylight == 1.0F &&
                   std::all_of(lighting.circuits.begin(), lighting.circuits.end(), [](float c) { return c == 1.0F; });
  made.now_.resize(day_.size());
  for (std::size_t i = 0; i < day_.size(); ++i) {
    made.now_[i] = kNever * kUsual + lighting.daylight * day_[i];
    for (std::size_t k = 0; k < kLampCircuits; ++k) made.now_[i] += lighting.circuits[k] * circuits_[k][i];
  }
  return made;
}

float CeilingLight::Field::sample(const std::vector<float>& cells, float x, float y) const {
  if (columns_ < 2 || rows_ < 2) return kUsual;
  constexpr float kPerMetre = 1.0F / static_cast<float>(kCell);
  const float u = std::clamp((x - x_) * kPerMetre, 0.0F, static_cast<float>(columns_) - 1.001F);
  const float v = std::clamp((y - y_) * kPerMetre, 0.0F, static_cast<float>(rows_) - 1.001F);
  const auto column = static_cast<std::size_t>(u), row = static_cast<std::size_t>(v);
  const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
  const std::size_t at = row * static_cast<std::size_t>(columns_) + column;
  const auto width = static_cast<std::size_t>(columns_);
  return (1.0F - t) * ((1.0F - s) * cells[at] + s * cells[at + 1]) +
         t * ((1.0F - s) * cells[at + width] + s * cells[at + width + 1]);
}

}  // namespace docent::simulator
