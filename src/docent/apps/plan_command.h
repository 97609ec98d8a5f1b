#pragma once

namespace CLI {
class App;
}

namespace docent {

/// `docent plan --map MAP.yaml --from X,Y --to X,Y`
void add_plan_command(CLI::App& app);

}  // namespace docent
