#include "docent/telepresence/uplink/envelope/envelope.h"

#include <nlohmann/json.hpp>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLargestPicture = 2'000'000;

std::string frame(const Json& head, const std::string& rest) {
  return head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" + rest;
}

/// What an envelope holds: its head, with text "" and number 0 where it has none of a kind.
class Opened {
 public:
  static Result<Opened> of(std::string_view bytes) {
    const auto end = bytes.find('\n');
    if (end == std::string_view::npos || end > kLongestHead) return fail("an envelope without a head");
    Opened opened;
    opened.head_ = Json::parse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (!opened.head_.is_object()) return fail("an envelope whose head is no object");
    opened.rest = bytes.substr(end + 1);
    return opened;
  }
  [[nodiscard]] std::string text(const char* key) const {
    const auto place = head_.find(key);
    return place != head_.end() && place->is_string() ? place->get<std::string>() : std::string{};
  }
  [[nodiscard]] std::uint64_t number(const char* key) const {
    const auto place = head_.find(key);
    return place != head_.end() && place->is_number_unsigned() ? place->get<std::uint64_t>() : 0;
  }
  [[nodiscard]] bool is_set(const char* key) const {
    const auto place = head_.find(key);
    return place != head_.end() && place->is_boolean() && place->get<bool>();
  }
  std::string rest;

 private:
  Json head_;
};

}  // namespace

bool fits_museum(std::string_view frame) {
  return frame.size() <= kLongestToMuseum && frame.substr(0, kLongestHead + 1).find('\n') != std::string_view::npos;
}

std::string encode(const FromMuseum& message) {
  if (const auto* slot = std::get_if<UplinkSlot>(&message))
    return frame({{"is", "slot"}, {"n", slot->slot}}, slot->text);
  if (const auto* answer = std::get_if<UplinkAnswer>(&message))
    return frame({{"is", "answer"}, {"n", answer->viewer}}, answer->text);
  if (const auto* piece = std::get_if<UplinkPiece>(&message)) {
    return frame({{"is", "piece"},
                  {"path", piece->path},
                  {"taken", piece->taken},
                  {"total", piece->total},
                  {"offset", piece->offset}},
                 piece->bytes);
  }
  const auto& reply = std::get<UplinkReply>(message);
  return frame({{"is", "reply"},
                {"n", reply.call},
                {"status", static_cast<unsigned>(reply.reply.status)},
                {"cookie", reply.reply.set_cookie}},
               reply.reply.body);
}

std::string encode(const ToMuseum& message) {
  if (const auto* said = std::get_if<UplinkMessage>(&message))
    return frame({{"is", "message"}, {"n", said->viewer}}, said->text);
  if (const auto* arrival = std::get_if<UplinkArrival>(&message))
    return frame({{"is", "arrival"}, {"address", arrival->address}}, "");
  const auto& call = std::get<UplinkCall>(message);
  const ApiRequest& request = call.request;
  return frame({{"is", "call"},
                {"n", call.call},
                {"method", request.method},
                {"target", request.target},
                {"token", request.token},
                {"csrf", request.csrf},
                {"address", request.address},
                {"json", request.is_json},
                {"ours", request.is_of_ours}},
               request.body);
}

Result<FromMuseum> decode_from_museum(std::string_view bytes) {
  auto opened = Opened::of(bytes);
  if (!opened) return tl::unexpected<Error>(opened.error());
  const std::string kind = opened->text("is");
  if (kind == "slot") return UplinkSlot{opened->number("n"), std::move(opened->rest)};
  if (kind == "answer") return UplinkAnswer{opened->number("n"), std::move(opened->rest)};
  if (kind == "reply") {
    return UplinkReply{opened->number("n"),
                       {static_cast<int>(std::min<std::uint64_t>(opened->number("status"), 599)),
                        std::move(opened->rest), opened->text("cookie")}};
  }
  if (kind != "piece") return fail("an envelope of an unknown kind");
  UplinkPiece piece{opened->text("path"), opened->text("taken"), opened->number("total"), opened->number("offset"),
                    std::move(opened->rest)};
  const bool fits =
      piece.total <= kLargestPicture && piece.offset <= piece.total && piece.bytes.size() <= piece.total - piece.offset;
  if (!fits) return fail("a piece that lies outside its picture");
  return piece;
}

Result<ToMuseum> decode_to_museum(std::string_view bytes) {
  auto opened = Opened::of(bytes);
  if (!opened) return tl::unexpected<Error>(opened.error());
  const std::string kind = opened->text("is");
  if (kind == "message") return UplinkMessage{opened->number("n"), std::move(opened->rest)};
  if (kind == "arrival") return UplinkArrival{opened->text("address")};
  if (kind != "call") return fail("an envelope of an unknown kind");
  ApiRequest request;
  request.method = opened->text("method");
  request.target = opened->text("target");
  request.token = opened->text("token");
  request.csrf = opened->text("csrf");
  request.address = opened->text("address");
  request.is_json = opened->is_set("json");
  request.is_of_ours = opened->is_set("ours");
  request.body = std::move(opened->rest);
  return UplinkCall{opened->number("n"), std::move(request)};
}

}  // namespace docent::telepresence
