#include "docent/telepresence/api/openapi.h"

#include <regex>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

Json parameters_of(const Endpoint& endpoint) {
  Json parameters = Json::array();
  static const std::regex kName{R"(\{(\w+)\})"};
  const std::string path = endpoint.path;
  for (std::sregex_iterator at{path.begin(), path.end(), kName}, end; at != end; ++at)
    parameters.push_back(
        {{"name", (*at)[1].str()}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}}}});
  for (const char* name : endpoint.query)
    parameters.push_back({{"name", name}, {"in", "query"}, {"required", false}, {"schema", {{"type", "string"}}}});
  if (endpoint.changes())
    parameters.push_back({{"name", "Docent-Csrf"},
                          {"in", "header"},
                          {"required", endpoint.least > Rank::viewer},
                          {"description", "`csrf` of GET /login, of everybody who has a login"},
                          {"schema", {{"type", "string"}}}});
  return parameters;
}

Json content_of(Json schema) { return {{"application/json", {{"schema", std::move(schema)}}}}; }

}  // namespace

std::string openapi_of(std::span<const Endpoint> endpoints) {
  Schemas schemas;
  const Json fault = schemas.add<documents::Fault>();
  Json paths = Json::object();
  for (const Endpoint& endpoint : endpoints) {
    std::string method = endpoint.method;
    for (char& c : method) c = static_cast<char>(c - 'A' + 'a');
    Json operation = {{"operationId", endpoint.name},
                      {"summary", endpoint.summary},
                      {"description", std::string{"For whoever is at least a "} + to_text(endpoint.least) + "."},
                      {"responses",
                       {{"200", {{"description", "Done"}, {"content", content_of(endpoint.reply(schemas))}}},
                        {"default", {{"description", "Refused"}, {"content", content_of(fault)}}}}}};
    const Json parameters = parameters_of(endpoint);
    if (!parameters.empty()) operation["parameters"] = parameters;
    if (endpoint.has_body)
      operation["requestBody"] = {{"required", true}, {"content", content_of(endpoint.request(schemas))}};
    if (endpoint.least > Rank::viewer) operation["security"] = Json::array({{{"login", Json::array()}}});
    paths[endpoint.path][method] = operation;
  }
  const Json document = {
      {"openapi", "3.1.0"},
      {"info",
       {{"title", "Docent"},
        {"version", "1"},
        {"description",
         "What the robot's Web server does for people: logins, the forum, counts. docs/web-protocol.md "
         "says the rest: the live channel, documents, pictures."}}},
      {"servers", Json::array({{{"url", "/api/v1"}}})},
      {"paths", paths},
      {"components",
       {{"schemas", schemas.all()},
        {"securitySchemes",
         {{"login", {{"type", "apiKey"}, {"in", "cookie"}, {"name", std::string{kLoginCookie}}}}}}}}};
  return document.dump(1) + "\n";
}

}  // namespace docent::telepresence
