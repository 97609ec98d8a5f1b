#pragma once

#include <string>

namespace CLI {
class App;
}

namespace docent::apps {

/// $DOCENT_CACHE, else $XDG_CACHE_HOME/docent, else ~/.cache/docent. Empty: no cache, as when the first is set to
/// nothing, and without a home: others might write into a folder that all share.
[[nodiscard]] std::string default_cache();

/// Options --cache DIR and --no-cache of a command. `folder`: gets what they say.
void add_cache_options(CLI::App& command, std::string& folder);

/// Makes the folder, if there is to be one. One that cannot be made or written is no error: a line of the log says so,
/// and what is made anew is not kept.
void prepare_cache(const std::string& folder);

}  // namespace docent::apps
