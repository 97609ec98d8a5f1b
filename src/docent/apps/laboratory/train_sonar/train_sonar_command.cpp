#include "docent/apps/laboratory/train_sonar/train_sonar_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/train_sonar/sonar_picture.h"
#include "docent/apps/laboratory/train_sonar/sonar_score.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"

namespace docent::apps::train_sonar_command {
namespace {

constexpr std::uint64_t kHeldOut = 1'000'000;  // seeds of worlds from here on are never trained in

struct Options {
  std::string out;
  std::string report;
  std::string picture;
  int worlds = 12;
  int places = 400;
  int cells = 80;
  int held_out = 5;
  std::vector<std::string> museums;
  double reach = 3.0;
  std::uint64_t seed = 1;
};

std::vector<mapping::SonarExample> draw_examples(const Options& options) {
  std::vector<mapping::SonarExample> examples;
  for (int i = 0; i < options.worlds; ++i) {
    const std::uint64_t seed = options.seed * 1000 + static_cast<std::uint64_t>(i);
    const SonarWorld world = SonarWorld::office(seed);
    const auto places = world.places(static_cast<std::size_t>(options.places), seed);
    const SonarTrial trial = drawn_trial(world, places, static_cast<std::size_t>(options.cells), options.reach, seed);
    examples.insert(examples.end(), trial.examples.begin(), trial.examples.end());
    std::fprintf(stderr, "world %d of %d: %zu examples\n", i + 1, options.worlds, examples.size());
  }
  return examples;
}

nlohmann::json to_json(const SonarScore& score) {
  return {{"examples", score.examples},
          {"cross_entropy_nat", score.cross_entropy},
          {"roc_area", score.roc_area},
          {"map_cells", score.cells},
          {"map_roc_area", score.map_roc_area}};
}

/// The hand-made model whose three probabilities suit the training worlds best: the fairest opponent.
mapping::ConeModelParams fitted_cones(const Options& options) {
  mapping::ConeModelParams best;
  double least = 1e9;
  const std::uint64_t seed = options.seed * 1000;
  const SonarWorld world = SonarWorld::office(seed);
  const auto places = world.places(60, seed);
  const SonarTrial trial = drawn_trial(world, places, 30, options.reach, seed);
  std::vector<bool> labels;
  for (const auto& example : trial.examples) labels.push_back(example.is_occupied);
  for (const double free : {0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4}) {
    for (const double echo : {0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8}) {
      for (const double unknown : {0.3, 0.4, 0.5, 0.6, 0.7}) {
        const mapping::ConeModelParams params{free, echo, unknown, best.thickness};
        std::vector<double> said;
        for (std::size_t i = 0; i < trial.at.size(); ++i) {
          said.push_back(
              probability_by_cones(params, ring_of_data_sheet(), places[trial.of_place[i]].view, trial.at[i]));
        }
        const double entropy = mapping::cross_entropy(said, labels);
        if (entropy >= least) continue;
        least = entropy;
        best = params;
      }
    }
  }
  return best;
}

void print_row(const std::string& world, const char* model, const SonarScore& score) {
  std::printf("  %-24s %-14s %8zu %10.3f %8.3f %10.3f\n", world.c_str(), model, score.examples, score.cross_entropy,
              score.roc_area, score.map_roc_area);
}

/// Both models, and the cones as they suit these worlds, in worlds that nothing was learned from.
nlohmann::json score_all(const Options& options, const mapping::SonarNetwork& network) {
  const SonarModel learned = by_network(network);
  const mapping::ConeModelParams by_hand;
  const mapping::ConeModelParams fitted = fitted_cones(options);
  nlohmann::json rows = nlohmann::json::array();
  std::printf("  %-24s %-14s %8s %10s %8s %10s\n", "world, never trained in", "model", "examples", "nat", "ROC",
              "map's ROC");
  const auto score = [&](const std::string& name, const SonarWorld& world, std::uint64_t seed) {
    nlohmann::json row{{"world", name}};
    const SonarScore of_network = score_sonar(world, seed, learned, network.prior(), options.reach);
    const SonarScore of_cones = score_sonar(world, seed, by_cones(by_hand), by_hand.unknown, options.reach);
    const SonarScore of_fitted = score_sonar(world, seed, by_cones(fitted), fitted.unknown, options.reach);
    print_row(name, "network", of_network);
    print_row(name, "cones", of_cones);
    print_row(name, "cones, fitted", of_fitted);
    row["network"] = to_json(of_network);
    row["cones"] = to_json(of_cones);
    row["cones_fitted"] = to_json(of_fitted);
    rows.push_back(std::move(row));
  };
  for (int i = 0; i < options.held_out; ++i) {
    const std::uint64_t seed = kHeldOut + options.seed * 1000 + static_cast<std::uint64_t>(i);
    score("office " + std::to_string(seed), SonarWorld::office(seed), seed);
  }
  for (const std::string& museum : options.museums) score(museum, SonarWorld::museum(museum), options.seed);
  return rows;
}

void train(const Options& options) {
  const auto examples = draw_examples(options);
  const auto network = mapping::SonarNetwork::trained(
      examples, ring_of_data_sheet(), {}, Rng{options.seed}.stream("sonar network"),
      [](int epoch, double entropy) { std::fprintf(stderr, "epoch %d: %.4f nat\n", epoch + 1, entropy); });
  value_or_fail(network.save(options.out));
  const nlohmann::json rows = score_all(options, network);
  if (!options.report.empty()) {
    const nlohmann::json report{{"examples", examples.size()}, {"prior", network.prior()}, {"held_out", rows}};
    value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
  }
  if (!options.picture.empty()) {
    const std::uint64_t seed = kHeldOut + options.seed * 1000;
    const mapping::ConeModelParams by_hand;
    value_or_fail(draw_sonar_models(SonarWorld::office(seed), seed, by_network(network), network.prior(),
                                    by_cones(by_hand), by_hand.unknown, options.reach)
                      .save(options.picture));
  }
  std::printf("%s: learned from %zu examples\n", options.out.c_str(), examples.size());
}

}  // namespace

void add_train_sonar_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("train-sonar", "Learn in simulated worlds what the sonars' readings say of a place");
  command->add_option("--out", options->out, "JSON file to write: the network")->check(output_file())->required();
  command->add_option("--worlds", options->worlds, "drawn office buildings to learn in")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--places", options->places, "of the robot in each")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--cells", options->cells, "about each place")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--reach", options->reach, "[m] about the robot")
      ->check(CLI::Range(0.5, 5.0))
      ->capture_default_str();
  command->add_option("--held-out", options->held_out, "other buildings, to score it in")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--museum", options->museums, "museum folder to score it in, too; may be repeated");
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->add_option("--picture", options->picture, "SVG, PDF or PNG file: one view and a whole map by both models")
      ->check(output_file());
  add_seed(*command, "--seed", options->seed, "seed of the worlds, the places and the first weights");
  command->callback([options] { train(*options); });
}

}  // namespace docent::apps::train_sonar_command
