#include "docent/apps/laboratory/take_pictures/picture_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "docent/base/files.h"
#include "docent/pictures/png/png_file.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_design.h"

namespace docent::apps::take_pictures_command {
namespace {

using simulator::RawPicture;
constexpr double kHeightCell = 0.5;  // [m] of the grid of heights

template <class... Numbers>
std::string line(const char* form, Numbers... numbers) {
  std::array<char, 300> text{};
  std::snprintf(text.data(), text.size(), form, numbers...);
  return text.data();
}

std::string name_of(std::size_t picture) { return line("%06d.png", static_cast<int>(picture)); }

class PictureRun {
 public:
  PictureRun(const simulator::World& world, const Drive& drive, const PictureRunOptions& options,
             std::filesystem::path folder)
      : world_{world},
        drive_{drive},
        options_{options},
        folder_{std::move(folder)},
        rng_{Rng{options.seed}.stream("pictures")},
        eyes_{options.eyes},
        up_gains_{gains("up gains")},
        front_gains_{gains("front gains")} {
    renderer_.set_furnishing(simulator::furnish(world));
    renderer_.set_figures({});
  }

  Result<void> make_folders() const {
    for (const auto& [name, is_wanted] : std::array<std::pair<const char*, bool>, 4>{
             {{"up", options_.up}, {"front", options_.front}, {"depth", options_.depth}, {"truth", true}}}) {
      std::error_code code;
      if (is_wanted) std::filesystem::create_directories(folder_ / name, code);
      if (code) return fail((folder_ / name).string() + ": cannot be made: " + code.message());
    }
    return {};
  }

  Result<void> take(std::size_t i) {
    const Moment& moment = drive_.moments[drive_.pictures[i]];
    simulator::Glimpse glimpse{.time = moment.time, .world_from_base = moment.world_from_base};
    const Pose2 next = inverse(moment.world_from_base) * drive_.at(moment.time + kTick);
    glimpse.linear = next.x / kTick, glimpse.angular = next.theta.radians() / kTick;
    glimpse.lighting = options_.lighting;
    Rng noise = rng_.stream("noise " + std::to_string(i));
    const auto& rig = options_.eyes.rig;
    if (options_.up) {
      glimpse.gain = up_gains_[i];
      const auto grey = eyes_.look_up(renderer_, glimpse, noise);
      if (auto saved = save("up", i, pictures::encode_png(rig.width, rig.height, grey)); !saved) return saved;
    }
    if (options_.front) {
      glimpse.gain = front_gains_[i];
      const auto image = eyes_.look_ahead(renderer_, glimpse, noise);
      if (auto saved = save("front", i, pictures::encode_png(image)); !saved) return saved;
    }
    if (options_.depth) {
      const auto depths = eyes_.measure_depths(renderer_, glimpse, noise);
      if (auto saved = save("depth", i, pictures::encode_png(rig.width, rig.height, depths)); !saved) return saved;
    }
    return {};
  }

  Result<void> write_texts() const {
    const ToldPoses told = told_poses(drive_, rng_.stream("told"));
    std::string poses = "picture,time,odometry_x,odometry_y,odometry_theta,map_x,map_y,map_theta\n";
    std::string truth = "picture,time,x,y,theta,roll,pitch,up_gain,front_gain\n";
    for (std::size_t i = 0; i < drive_.pictures.size(); ++i) {
      const Moment& moment = drive_.moments[drive_.pictures[i]];
      const Pose2 &o = told.odometry[i], &m = told.map[i], &t = moment.world_from_base;
      const simulator::Lean lean = eyes_.lean_at(moment.time);
      const int number = static_cast<int>(i);
      poses += line("%06d,%.3f,%.5f,%.5f,%.6f,%.5f,%.5f,%.6f\n", number, moment.time, o.x, o.y, o.theta.radians(), m.x,
                    m.y, m.theta.radians());
      truth += line("%06d,%.3f,%.5f,%.5f,%.6f,%.6f,%.6f,%.4f,%.4f\n", number, moment.time, t.x, t.y, t.theta.radians(),
                    lean.roll, lean.pitch, up_gains_[i], front_gains_[i]);
    }
    for (const auto& [name, text] :
         std::array<std::pair<const char*, std::string>, 5>{{{"poses.csv", poses},
                                                             {"truth/poses.csv", truth},
                                                             {"cameras.yaml", to_yaml(eyes_.told())},
                                                             {"truth/cameras.yaml", to_yaml(eyes_.truth())},
                                                             {"truth/ceiling.csv", heights()}}}) {
      if (auto written = write_file_atomically(folder_ / name, text); !written) return written;
    }
    return {};
  }

 private:
  [[nodiscard]] std::vector<double> gains(const char* stream) const {
    return simulator::stepped_gains(drive_.pictures.size(), options_.exposure_steps, options_.exposure_range,
                                    rng_.stream(stream));
  }
  [[nodiscard]] Result<void> save(const char* kind, std::size_t i, const Result<std::string>& file) const {
    if (!file) return tl::unexpected<Error>(file.error());
    return write_file_atomically(folder_ / kind / name_of(i), *file);
  }
  [[nodiscard]] std::string heights() const {
    const simulator::Ceiling ceiling = simulator::design_ceiling(world_);
    Point2 low = world_.floor.front(), high = low;
    for (const Point2 p : world_.floor) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    std::string text = "x,y,height\n";
    for (double y = low.y + 0.5 * kHeightCell; y < high.y; y += kHeightCell)
      for (double x = low.x + 0.5 * kHeightCell; x < high.x; x += kHeightCell)
        if (contains(world_.floor, {x, y}))
          text += line("%.2f,%.2f,%.4f\n", x, y, ceiling.fields[ceiling.field_at({x, y})].height);
    return text;
  }

  const simulator::World& world_;
  const Drive& drive_;
  const PictureRunOptions& options_;
  std::filesystem::path folder_;
  Rng rng_;
  simulator::RobotEyes eyes_;
  std::vector<double> up_gains_, front_gains_;
  simulator::Renderer renderer_;
};

}  // namespace

Result<void> take_pictures(const simulator::World& world, const Drive& drive, const PictureRunOptions& options,
                           const std::filesystem::path& folder, const std::function<void(std::size_t)>& taken) {
  PictureRun run{world, drive, options, folder};
  if (auto made = run.make_folders(); !made) return made;
  if (auto written = run.write_texts(); !written) return written;
  for (std::size_t i = 0; i < drive.pictures.size(); ++i) {
    if (auto took = run.take(i); !took) return took;
    taken(i + 1);
  }
  return {};
}

}  // namespace docent::apps::take_pictures_command
