#pragma once

namespace CLI {
class App;
}

namespace docent::apps::train_sonar_command {

/// `docent-lab train-sonar`: learns the inverse sensor model of the sonars in known simulated worlds
/// ([Rhino1999] 3.2.2).
void add_train_sonar_command(CLI::App& app);

}  // namespace docent::apps::train_sonar_command
