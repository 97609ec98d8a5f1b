#pragma once

namespace CLI {
class App;
}

namespace docent::apps::plan_command {

/// `docent-lab plan --map MAP.yaml | --museum FOLDER --from X,Y --to X,Y [--coastal WEIGHT]`
void add_plan_command(CLI::App& app);

}  // namespace docent::apps::plan_command
