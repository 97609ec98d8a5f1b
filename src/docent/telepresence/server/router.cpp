#include "docent/telepresence/server/router.h"

#include <utility>

namespace docent::telepresence {
namespace {

constexpr std::string_view kLive = "/live";
constexpr std::string_view kOperate = "/operate";
constexpr std::string_view kApi = "/api/v1/";
constexpr std::string_view kFoxglove = "/foxglove";
constexpr std::string_view kThinLive = "/live?thin";
constexpr std::string_view kLiveOfScreen = "/live?screen=";

constexpr const char* kForThisComputer =
    "for programs of the robot's own computer; web.foxglove_by_proxy lets in whom a proxy of web.proxies hands on\n";
/// What whoever set up a proxy has to know.
constexpr const char* kBehindAProxy =
    ": the name in Origin is not the one that was called. A proxy must pass on Host or X-Forwarded-Host, and belongs "
    "into "
    "web.proxies of robot.yaml; web.origins names other sites\n";

}  // namespace

HttpAnswer refusal(int status, std::string text) {
  HttpAnswer answer;
  answer.reply.status = status;
  answer.reply.body = std::make_shared<const std::string>(std::move(text));
  answer.is_last = true;
  return answer;
}

Route Router::route(const RouteRequest& request, bool is_full) const {
  if (request.is_upgrade && request.target == kFoxglove) {
    if (!role_of(request.opening, origins_, screen_key_))
      return refusal(403, std::string{"pages of another site may not look in"} + kBehindAProxy);
    if (!request.is_local) return refusal(403, kForThisComputer);
    return OpenFoxglove{};
  }
  if (request.is_upgrade && request.target == kOperate) {
    if (!role_of(request.opening, origins_, screen_key_))
      return refusal(403, std::string{"pages of another site may not steer the robot"} + kBehindAProxy);
    return OpenOperate{};
  }
  if (request.is_upgrade) {
    const bool is_screen = request.target.starts_with(kLiveOfScreen) && request.target != kLiveOfScreen;
    const bool is_thin = request.target == kThinLive;
    if (!is_screen && !is_thin && request.target != kLive) return refusal(404, "not found\n");
    Opening opening = request.opening;
    if (is_screen) opening.key = request.target.substr(kLiveOfScreen.size());
    const auto role = role_of(opening, origins_, screen_key_);
    if (!role && is_screen) return refusal(403, "this is not the robot's own screen\n");
    if (!role) return refusal(403, std::string{"pages of another site may not steer the robot"} + kBehindAProxy);
    if (is_full) return refusal(503, "too many viewers\n");
    return OpenLive{*role, is_thin};
  }
  if (request.target.starts_with(kApi)) return CallApi{};
  const bool is_head = request.method == "HEAD";
  if (!is_head && request.method != "GET") return refusal(405, "GET only\n");
  return HttpAnswer{site_->get(request.target), is_head, false};
}

}  // namespace docent::telepresence
