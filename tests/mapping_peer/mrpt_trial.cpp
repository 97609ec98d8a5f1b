// docent_mrpt_trial MAP.yaml LOG OUT_FOLDER [reverse] [perturbed SEED]: map and log of one trial of
// `scripts/evaluate localize-logs --part starts` as MRPT's pf-localization wants them, map.gridmap and log.rawlog.
// perturbed: the even scans, with the odometry that `docent localize --odometry perturbed` makes of that seed.
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "docent/apps/localize/log_reference.h"
#include "docent/grid/occupancy_grid.h"
#include "mrpt_scan.h"

namespace {

mrpt::maps::COccupancyGridMap2D as_mrpt(const docent::OccupancyGrid& map) {
  const auto& frame = map.frame;
  const auto resolution = static_cast<float>(frame.resolution);
  mrpt::maps::COccupancyGridMap2D grid;
  grid.setSize(static_cast<float>(frame.origin.x),
               static_cast<float>(frame.origin.x) + resolution * static_cast<float>(frame.columns),
               static_cast<float>(frame.origin.y),
               static_cast<float>(frame.origin.y) + resolution * static_cast<float>(frame.rows), resolution, 0.5F);
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) {
      const auto cell = map.at({column, row});
      const float free = cell == docent::OccupancyGrid::kUnknown ? 0.5F : 1.0F - 0.01F * static_cast<float>(cell);
      grid.setCell(column, row, std::clamp(free, 0.01F, 0.99F));
    }
  return grid;
}

template <class Write>
bool write_archive(const std::string& path, const Write& write) {
  mrpt::io::CFileGZOutputStream file;
  if (!file.open(path)) {
    std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
    return false;
  }
  auto archive = mrpt::serialization::archiveFrom(file);
  write(archive);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: docent_mrpt_trial MAP.yaml LOG OUT_FOLDER [reverse] [perturbed SEED]\n", stderr);
    return 2;
  }
  const auto map = docent::load_map(argv[1]);
  if (!map) {
    std::fprintf(stderr, "%s\n", map.error().message.c_str());
    return 1;
  }
  docent::apps::localize_command::LogChoice choice;
  choice.log = argv[2];
  bool reverse = false;
  const char* seed = nullptr;
  for (int i = 4; i < argc; ++i) {
    if (std::strcmp(argv[i], "reverse") == 0) reverse = true;
    if (std::strcmp(argv[i], "perturbed") == 0 && i + 1 < argc) seed = argv[++i];
  }
  if (seed != nullptr) {
    choice.reference = "logged";
    choice.scans = "even";
  }
  auto referenced = docent::apps::localize_command::load_referenced_log(choice);
  if (seed != nullptr) docent::apps::localize_command::replace_odometry(referenced, {}, std::stoull(seed));
  auto& log = referenced.log;
  if (reverse) std::reverse(log.scans.begin(), log.scans.end());  // MRPT asks for the ways between scans alone
  const std::string folder = argv[3];
  return write_archive(folder + "/map.gridmap", [&](auto& archive) { archive << as_mrpt(*map); }) &&
                 write_archive(folder + "/log.rawlog",
                               [&](auto& archive) { docent::peers::write_rawlog(log, archive); })
             ? 0
             : 1;
}
