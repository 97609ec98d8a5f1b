#pragma once

#include <map>
#include <string>

namespace docent::telepresence {

/// The page's side of documents.h and client_message.h, as it stands in web/src/contract.
[[nodiscard]] std::string contract_types();

/// Documents of every kind as the server sends them, by the name of a file in tests/web_contract/server; among them
/// some of the same kind that leave out what may be left out.
[[nodiscard]] std::map<std::string, std::string> contract_samples();

}  // namespace docent::telepresence
