#include "docent/apps/eyes/calibrate_camera_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/eyes/board_pictures.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/pictures/figure.h"
#include "docent/pictures/map_picture.h"
#include "docent/vision/calibration/lens_calibration.h"
#include "docent/vision/lens/lens_file.h"

namespace docent::apps::calibrate_camera_command {
namespace {

struct Options {
  std::string from;
  std::string topic;
  std::string board = "9x6";
  std::string out;
  std::string figure;
  double a_second = 2.0;
  vision::Board size{};
  bool is_fisheye = false;
  vision::LensCalibrationParams params;
};

/// What was found in all pictures.
struct Seen {
  int columns = 0, rows = 0;
  std::vector<vision::BoardView> views;
  std::vector<std::string> notes;  ///< pictures without a board, and why
};

void parse_board(Options& options) {
  const char* end = options.board.data() + options.board.size();
  const auto [x, fault] = std::from_chars(options.board.data(), end, options.size.columns);
  const bool has_rows = fault == std::errc{} && x != end && *x == 'x' &&
                        std::from_chars(x + 1, end, options.size.rows).ptr == end && x + 1 != end;
  if (!has_rows) throw CommandFailed{"--board " + options.board + ": expected COLUMNSxROWS inner corners, as 9x6", 2};
  if (auto valid = options.size.validate(); !valid)
    throw CommandFailed{"--board " + options.board + ": " + valid.error().message, 2};
}

Seen look(const Options& options) {
  Seen seen;
  value_or_fail(read_pictures(options.from, options.topic, options.a_second, [&](GreyImage picture) {
    if (!picture.fault.empty()) return seen.notes.push_back(picture.name + ": " + picture.fault);
    if (seen.columns == 0) seen.columns = picture.columns, seen.rows = picture.rows;
    if (picture.columns != seen.columns || picture.rows != seen.rows)
      return seen.notes.push_back(picture.name + ": is of another size than the first picture");
    auto corners = vision::find_board(picture.grey, picture.columns, picture.rows, options.size);
    if (!corners) return seen.notes.push_back(picture.name + ": no board of " + options.board + " inner corners");
    seen.views.push_back({picture.name, std::move(*corners)});
  }));
  return seen;
}

/// Where the corners lay, picture by picture.
pictures::Figure draw(const Seen& seen, const vision::LensCalibration& made) {
  pictures::Figure figure{"Where the corners lay"};
  constexpr double kWide = 480.0, kDot = 2.5;  // [points]
  pictures::Axes& axes = figure.add(pictures::Axes{{0.0, 0.0},
                                                   {static_cast<double>(seen.columns), static_cast<double>(seen.rows)},
                                                   kWide,
                                                   kWide * seen.rows / seen.columns,
                                                   "column [pixels]",
                                                   "row, from below [pixels]"});
  for (std::size_t i = 0; i < seen.views.size(); ++i) {
    std::vector<Point2> dots;
    for (const auto& corner : seen.views[i].corners) dots.push_back({corner.x(), seen.rows - corner.y()});
    pictures::draw_points(axes, dots, kDot, pictures::distinct(static_cast<int>(i)));
  }
  char text[80];
  std::snprintf(text, sizeof text, "%zu pictures, %.0f %% of the picture covered, %.3f pixels RMS", seen.views.size(),
                100.0 * made.coverage, made.rms);
  axes.set_title(text);
  return figure;
}

void calibrate(Options& options) {
  parse_board(options);
  options.params.kind = options.is_fisheye ? vision::LensParams::Kind::fisheye : vision::LensParams::Kind::pinhole;
  const Seen seen = look(options);
  for (const std::string& note : seen.notes) std::printf("%s\n", note.c_str());
  const auto made = vision::calibrate_lens(seen.views, options.size, seen.columns, seen.rows, options.params);
  if (!made) throw CommandFailed{options.from + ": " + made.error().message};
  const std::string head = "# By docent calibrate-camera: " + std::to_string(seen.views.size()) +
                           " pictures of a board. Pixels from the upper left corner of the picture.\n";
  value_or_fail(write_file_atomically(options.out, head + vision::lens_to_yaml(made->lens)));
  if (!options.figure.empty()) value_or_fail(draw(seen, *made).save(options.figure));
  for (const vision::CalibratedView& view : made->views)
    std::printf("%8.3f pixels RMS, turned by %4.1f degrees: %s%s\n", view.rms, view.tilt, view.name.c_str(),
                view.counts ? "" : " (fits far worse than the others: left out)");
  std::printf("%s: %.3f pixels RMS; boards cover %.0f %% of the picture; focal length %.2f x %.2f", options.out.c_str(),
              made->rms, 100.0 * made->coverage, made->lens.focal_x, made->lens.focal_y);
  if (!options.is_fisheye)
    std::printf(" +- %.2f, centre +- %.2f", made->focal_sigma[0],
                std::max(made->centre_sigma[0], made->centre_sigma[1]));
  std::printf(" pixels\n");
  for (const std::string& doubt : made->doubts) std::printf("doubtful: %s\n", doubt.c_str());
}

}  // namespace

void add_calibrate_camera_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("calibrate-camera", "Find what a camera's lens is like, from pictures of a checkerboard");
  auto options = std::make_shared<Options>();
  command
      ->add_option("pictures", options->from,
                   "Folder of pictures (PNG, PGM, JPEG) of a board that is held near and far, turned, and near the "
                   "edges; or a recording (MCAP) of the camera's topic")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--topic", options->topic, "Topic of the recording; without: the only one with pictures");
  command->add_option("--a-second", options->a_second, "Pictures of a recording that are used, at most")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--board", options->board, "Inner corners of the board, COLUMNSxROWS")->capture_default_str();
  command->add_option("--square", options->size.square, "[m] side of a square")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--fisheye", options->is_fisheye, "The lens sees more than about 110 degrees");
  command->add_option("--out", options->out, "Lens to write, as robot.yaml's capture.lens reads it (YAML)")
      ->required()
      ->check(output_file());
  command->add_option("--figure", options->figure, "SVG, PDF or PNG file to write: where the corners lay")
      ->check(output_picture());
  command->callback([options] { calibrate(*options); });
}

}  // namespace docent::apps::calibrate_camera_command
