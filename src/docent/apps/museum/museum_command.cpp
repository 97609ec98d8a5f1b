#include "docent/apps/museum/museum_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/map_note.h"
#include "docent/museum/museum.h"
#include "docent/pictures/map_picture.h"
#include "docent/simulator/pedestrians/recording.h"
#include "docent/simulator/traced/given_map.h"
#include "docent/simulator/traced/traced_museum.h"
#include "docent/simulator/world/world_picture.h"

namespace docent::apps::museum_command {
namespace {

namespace fs = std::filesystem;

struct MuseumOptions {
  std::string map;
  std::string out;
  std::string title;
  std::string picture;
  std::string places;
  std::vector<std::string> pedestrians;
  std::uint64_t seed = 1;
};

/// A path, or the name of a recording in DOCENT_DATA/pedestrians.
fs::path recording_path(const std::string& name_or_path) {
  std::error_code code;
  if (fs::exists(name_or_path, code)) return name_or_path;
  const char* data = std::getenv("DOCENT_DATA");
  const fs::path recordings = fs::path{data != nullptr ? data : "../shared/data"} / "pedestrians";
  fs::path found = recordings / (name_or_path == "univ" ? "students01" : name_or_path);
  if (fs::exists(found, code)) return found;
  throw CommandFailed{"--pedestrians " + name_or_path + ": neither a path nor a recording in " + recordings.string() +
                      " (DOCENT_DATA)"};
}

void print_fit(const simulator::PedestrianFit& fit) {
  const Pose2& pose = fit.world_from_recording;
  const std::size_t kept = fit.recording.tracks.size();
  const std::size_t all = kept + fit.dropped;
  if (kept == 0) throw CommandFailed{"--pedestrians: no track of " + fit.recording.name + " has room on this map"};
  std::printf(
      "%s: %zu of %zu tracks kept (%.0f %%), %zu walk through walls; turned by %.1f degrees, moved by %.2f, %.2f m; "
      "%.1f people on average, a loop of %.0f s\n",
      fit.recording.name.c_str(), kept, all, 100.0 * static_cast<double>(kept) / static_cast<double>(all), fit.dropped,
      pose.theta.degrees(), pose.x, pose.y, fit.recording.mean_people(), fit.recording.duration);
}

/// The true world with the ways of the recorded people, and beside it what the robot is told.
pictures::Figure draw(const simulator::World& world, const simulator::Survey& survey, const std::string& title) {
  constexpr double kSide = 420.0;  // [points]
  constexpr pictures::Color kTrack = pictures::with_alpha(pictures::colors::kViolet, 60);
  pictures::Figure figure{title};
  pictures::Axes& truth = figure.add(pictures::Axes::metres(survey.map.frame, kSide));
  truth.set_title("true world");
  simulator::draw_world(truth, world);
  for (const auto& recording : world.pedestrians)
    for (const auto& track : recording.tracks) pictures::draw_path(truth, track.points, 0.5, kTrack);
  pictures::Axes& told = figure.add(pictures::Axes::metres(survey.map.frame, kSide));
  told.set_title("map and hazards, as surveyed");
  simulator::draw_survey(told, survey);
  simulator::draw_operating_area(told, world);
  simulator::add_world_legend(figure, world);
  if (!world.pedestrians.empty())
    figure.add_legend(pictures::legend_line("recorded person's way", 0.5, pictures::colors::kViolet));
  simulator::add_survey_legend(figure, survey);
  return figure;
}

void run(const MuseumOptions& options) {
  const fs::path out{options.out};
  const OccupancyGrid map = load_and_say(options.map);
  const std::string title = options.title.empty() ? fs::path{options.map}.stem().string() : options.title;
  std::vector<simulator::Recording> recordings;
  for (const std::string& name : options.pedestrians) {
    recordings.push_back(value_or_fail(simulator::load_recording(recording_path(name))));
  }
  std::optional<simulator::Places> places;
  if (!options.places.empty()) places = value_or_fail(simulator::load_places(options.places));
  const auto traced = simulator::trace_museum(map, recordings, title, options.seed, places);
  if (!traced) throw CommandFailed{options.map + ": " + traced.error().message};
  const simulator::MuseumPlan& plan = traced->plan;
  for (const auto& fit : traced->fits) print_fit(fit);
  if (traced->carried_away > 0) std::printf("%zu small things carried out of their way\n", traced->carried_away);
  simulator::Survey survey = simulator::survey(plan.world, {}, Rng{options.seed}.stream("survey"));
  survey.map = simulator::with_given_map(map, traced->frame, traced->building, survey.map);
  value_or_fail(simulator::write_museum(plan, survey, out));
  std::printf(
      "%s: %zu exhibits, %zu solids, %zu hazards, %zu pieces drawn where they no longer stand, %zu not on the map\n",
      (out / "museum.yaml").c_str(), plan.stops.size(), plan.world.solids.size(), survey.hazards.size(),
      survey.moved.size(), survey.missing.size());
  if (!options.picture.empty()) value_or_fail(draw(plan.world, survey, title).save(options.picture));
  const std::vector<Error> faults = museum::check_museum(out);
  for (const Error& fault : faults) std::fprintf(stderr, "%s\n", fault.message.c_str());
  if (!faults.empty())
    throw CommandFailed{out.string() + (places ? ": cannot work; mend " + options.places + " and run this again"
                                               : std::string{": cannot work; another --seed may help"})};
}

}  // namespace

void add_museum_command(CLI::App& app) {
  auto* command = app.add_subcommand("museum", "Make a museum folder from a map: exhibits, hazards, recorded people");
  auto options = std::make_shared<MuseumOptions>();
  command->add_option("map", options->map, "map.yaml of map_server")->required();
  command->add_option("--out", options->out, "Folder for museum.yaml, simulation.yaml, the map and texts")
      ->check(output_folder())
      ->required();
  command
      ->add_option("--pedestrians", options->pedestrians,
                   "Recorded people for its halls: a folder or file, or a name in DOCENT_DATA/pedestrians (eth, "
                   "univ, zara01, edinburgh, …); several are fitted one by one")
      ->type_name("NAME-or-DIR");
  command->add_option("--places", options->places,
                      "YAML file that says where to stop and what no sensor sees, instead of drawing that: exhibits, "
                      "hazards, home, charger (docs/museums.md)");
  add_seed(*command, "--seed", options->seed, "Seed of what a map does not show and of the survey's errors");
  command->add_option("--title", options->title, "Name of the museum; without it the map's file name");
  command->add_option("--picture", options->picture, "Also draw the true world and the robot's map")
      ->check(output_picture());
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::museum_command
