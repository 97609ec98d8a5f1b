#include "docent/evaluation/reference/relations.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "docent/base/files.h"
#include "docent/evaluation/reference/number_lines.h"

namespace docent::evaluation {
namespace {

std::optional<Pose2> pose_at(std::span<const TimedPose> poses, Time time) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), time, [](const auto& p, Time t) { return p.time < t; });
  if (after == poses.end()) return std::nullopt;
  if (after->time == time) return after->map_from_base;
  if (after == poses.begin()) return std::nullopt;
  const TimedPose& a = *std::prev(after);
  const double share = to_seconds(time - a.time) / to_seconds(after->time - a.time);
  const Pose2& b = after->map_from_base;
  return Pose2{a.map_from_base.x + share * (b.x - a.map_from_base.x),
               a.map_from_base.y + share * (b.y - a.map_from_base.y),
               a.map_from_base.theta + Angle::radians(share * (b.theta - a.map_from_base.theta).radians())};
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

Result<std::vector<Relation>> parse_relations(std::string_view text, const std::string& name) {
  const auto lines = parse_number_lines(text, name, "t1 t2 x y z roll pitch yaw");
  if (!lines) return tl::unexpected<Error>(lines.error());
  std::vector<Relation> relations;
  for (const std::vector<double>& line : *lines) {
    if (std::abs(line[1]) > 9e9) return fail(name + ": a time is out of range");
    relations.push_back(
        {time_from_seconds(line[0]), time_from_seconds(line[1]), {line[2], line[3], Angle::radians(line[7])}});
  }
  if (relations.empty()) return fail(name + ": holds no relation");
  return relations;
}

Result<std::vector<Relation>> load_relations(const std::filesystem::path& path) {
  const auto text = read_maybe_gzipped(path);
  if (!text) return tl::unexpected<Error>(text.error());
  return parse_relations(*text, path.string());
}

RelationScore score_relations(std::span<const Relation> relations, std::span<const TimedPose> poses) {
  std::vector<double> metres;
  std::vector<double> degrees;
  for (const Relation& relation : relations) {
    const auto first = pose_at(poses, relation.first);
    const auto second = pose_at(poses, relation.second);
    if (!first || !second) continue;
    const Pose2 error = inverse(relation.first_from_second) * (inverse(*first) * *second);
    metres.push_back(norm(error.position()));
    degrees.push_back(std::abs(error.theta.degrees()));
  }
  RelationScore score{metres.size(), mean_of(metres), spread_of(metres), 0.0, mean_of(degrees), spread_of(degrees)};
  if (!metres.empty()) score.metres_worst = *std::max_element(metres.begin(), metres.end());
  return score;
}

std::vector<Relation> relations_between(std::span<const TimedPose> truth, std::span<const double> apart) {
  std::vector<double> way(truth.size(), 0.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    way[i] = way[i - 1] + distance(truth[i - 1].map_from_base.position(), truth[i].map_from_base.position());
  }
  std::vector<Relation> relations;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (const double metres : apart) {
      const auto reached = std::lower_bound(way.begin(), way.end(), way[i] + metres);
      if (reached == way.end()) continue;
      const TimedPose& other = truth[static_cast<std::size_t>(reached - way.begin())];
      relations.push_back({truth[i].time, other.time, inverse(truth[i].map_from_base) * other.map_from_base});
    }
  }
  return relations;
}

}  // namespace docent::evaluation
