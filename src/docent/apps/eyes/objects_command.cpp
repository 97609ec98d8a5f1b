#include "docent/apps/eyes/objects_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/eyes/object_pictures.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"

namespace docent::apps::objects_command {
namespace {

struct LearnOptions {
  std::string pictures;
  std::string out;
  vision::ObjectBookParams params;
};

struct NameOptions {
  std::string book;
  std::vector<std::string> pictures;
  std::string regions;
};

void learn(const LearnOptions& options) {
  std::vector<vision::Example> examples;
  for (const ObjectFolder& folder : value_or_fail(object_folders(options.pictures))) {
    std::printf("%-20s %3zu pictures\n", folder.object.c_str(), folder.pictures.size());
    std::fflush(stdout);
    for (const auto& path : folder.pictures)
      examples.push_back({folder.object, see(value_or_fail(read_picture(path))).features});
  }
  const auto book = value_or_fail(vision::ObjectBook::learn(examples, options.params));
  value_or_fail(book.save(options.out));
  std::size_t right = 0;
  for (const vision::Example& example : examples) right += book.name(example.features).object == example.object ? 1 : 0;
  std::printf("%s: %zu objects from %zu pictures; of these it names %zu rightly, of others it will name fewer\n",
              options.out.c_str(), book.objects().size(), examples.size(), right);
}

void name(const NameOptions& options) {
  const auto book = value_or_fail(vision::ObjectBook::load(options.book));
  for (const std::string& path : options.pictures) {
    const pictures::Image picture = value_or_fail(read_picture(path));
    const SeenPicture seen = see(picture);
    const auto found = book.name(seen.features);
    const std::string what = found.is_known ? found.object : "unknown, most like " + found.object;
    std::printf("%s: %s (distance %.1f)\n", path.c_str(), what.c_str(), found.distance);
    if (!options.regions.empty()) value_or_fail(draw_regions(picture, seen, what).save(options.regions));
  }
}

}  // namespace

void add_learn_objects_command(CLI::App& app) {
  auto* command = app.add_subcommand("learn-objects", "Teach the robot things by pictures of them");
  auto options = std::make_shared<LearnOptions>();
  command
      ->add_option("pictures", options->pictures,
                   "Folder with a folder of JPEG pictures for each object, 30 to 50 of each")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Object book to write (JSON)")->required()->check(output_file());
  command
      ->add_option("--known", options->params.known,
                   "Share of an object's own pictures that is to be known again; the rest is called unknown")
      ->capture_default_str();
  command->callback([options] { learn(*options); });
}

void add_name_objects_command(CLI::App& app) {
  auto* command = app.add_subcommand("name-objects", "Name the things that pictures show");
  auto options = std::make_shared<NameOptions>();
  command->add_option("pictures", options->pictures, "JPEG pictures, of one thing each")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--book", options->book, "Object book of docent learn-objects")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("--regions", options->regions,
                   "SVG, PDF or PNG file to write: the picture and its regions; of one picture")
      ->check(output_picture());
  command->callback([options] {
    if (!options->regions.empty() && options->pictures.size() > 1)
      throw CommandFailed{"--regions draws one picture; it was given " + std::to_string(options->pictures.size()), 2};
    name(*options);
  });
}

}  // namespace docent::apps::objects_command
