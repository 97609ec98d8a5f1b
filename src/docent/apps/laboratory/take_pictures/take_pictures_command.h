#pragma once

namespace CLI {
class App;
}

namespace docent::apps::take_pictures_command {

/// `docent-lab take-pictures`: what cameras see on a drive through an empty museum.
void add_take_pictures_command(CLI::App& app);

}  // namespace docent::apps::take_pictures_command
