#pragma once

namespace CLI {
class App;
}

namespace docent::apps::objects_command {

/// `docent learn-objects`: teaches things by pictures of them.
void add_learn_objects_command(CLI::App& app);
/// `docent name-objects`: names what pictures show, and draws their regions ([Buhmann1995], figure 5).
void add_name_objects_command(CLI::App& app);

}  // namespace docent::apps::objects_command
