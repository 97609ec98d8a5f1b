#include "docent/apps/laboratory/evaluate/evaluate_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/recording/recorder.h"

namespace docent::apps::evaluate_command {
namespace {

struct Options {
  std::string recording;
  std::string report;
};

void evaluate(const Options& options) {
  recording::McapReader reader = value_or_fail(recording::McapReader::open(options.recording));
  if (!reader.is_complete())
    std::fprintf(stderr, "docent-lab: %s: the recorder did not come to an end; its last second may be missing\n",
                 options.recording.c_str());
  evaluation::DeploymentEvaluator evaluator;
  auto read = recording::read_recording(reader, {}, [&](const recording::RecordedMessage& message) {
    evaluator.add(message.topic, message.time, message.message);
    return true;
  });
  if (!read && read.error().message.rfind(options.recording, 0) != 0)
    read = fail(options.recording + ": " + read.error().message);
  value_or_fail(std::move(read));
  const evaluation::DeploymentReport report = evaluator.report();
  if (!evaluator.has_truth()) {
    if (report.latency) std::printf("  scan to drive   %s\n", evaluation::to_text(*report.latency).c_str());
    if (report.latency && options.report.empty()) return;
    throw CommandFailed{options.recording + ": holds no ground truth (/truth/state)"};
  }
  std::fputs(evaluation::summary_table(report, std::nullopt).c_str(), stdout);
  if (options.report.empty()) return;
  value_or_fail(write_file_atomically(options.report, evaluation::to_json(report, std::nullopt)));
  std::printf("report %s\n", options.report.c_str());
}

}  // namespace

void add_evaluate_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("evaluate", "Compute the report of a run again, from its recording");
  command->add_option("recording", options->recording, "MCAP file")->required();
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->callback([options] { evaluate(*options); });
}

}  // namespace docent::apps::evaluate_command
