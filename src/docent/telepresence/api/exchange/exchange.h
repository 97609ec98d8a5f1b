#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "docent/base/result.h"

// Between the Web server, which knows HTTP and nobody's name, and the desk that answers /api/v1 (api/).

namespace docent::telepresence {

/// A request to /api/v1, its lengths bounded, nothing else checked.
struct ApiRequest {
  std::string method;      ///< GET, POST, PUT, DELETE
  std::string target;      ///< as it came, with its query
  std::string body;        ///< at most longest_body_of(target) bytes
  std::string token;       ///< of the cookie; empty: none came
  std::string csrf;        ///< of the header Docent-Csrf
  std::string address;     ///< from where it comes
  bool is_json = false;    ///< it says that its body is JSON
  bool is_of_ours = true;  ///< no page of another site sends it
  bool is_far = false;     ///< it comes through a gateway far away, of which operators must be nearer
};
inline constexpr std::size_t kLongestTarget = 2048;       ///< bytes
inline constexpr std::size_t kLongestBody = 16'384;       ///< bytes
inline constexpr std::size_t kLongestMuseum = 1'048'576;  ///< bytes: with the texts of all exhibits
/// [bytes] Only a museum is larger than everything else; the server reads few of them at a time.
[[nodiscard]] constexpr std::size_t longest_body_of(std::string_view target) {
  return target.starts_with("/api/v1/museum") ? kLongestMuseum : kLongestBody;
}

struct ApiReply {
  int status = 200;
  std::string body;        ///< JSON
  std::string set_cookie;  ///< empty: none
};

/// An operator who has logged in.
struct Admission {
  std::string name;
  std::string login;  ///< which of their logins, as `ended` names it
};

/// nullopt: it is no operator's login. Error: nobody can be asked now.
using Admitted = Result<std::optional<Admission>>;

/// Answers from threads of its own: what it is asked may wait for a disk.
class ApiDesk {
 public:
  ApiDesk() = default;
  ApiDesk(const ApiDesk&) = delete;
  ApiDesk& operator=(const ApiDesk&) = delete;
  virtual ~ApiDesk() = default;
  /// Any thread. `answer` is called once, by whichever thread, also when the desk is full.
  virtual void take(ApiRequest request, std::function<void(ApiReply)> answer) = 0;
  /// Whose login it is.
  virtual void admit(std::string token, std::function<void(Admitted)> answer) = 0;
  /// Whether somebody with an account was let in from there before. Any thread.
  [[nodiscard]] virtual bool is_staff_from(const std::string& /*address*/) const { return false; }
  /// Told on any thread which logins are over. Once this returns, the one before is told nothing more. @pre returns
  /// soon
  virtual void when_ended(std::function<void(const std::string& login)> /*told*/) {}
  /// Nothing is asked any more: whatever waits for somebody else is answered at once.
  virtual void close() {}
};

inline constexpr std::string_view kLoginCookie = "docent_login";
/// The value of a cookie in the header `Cookie` (RFC 6265, 4.2.1); empty: it has none of that name.
[[nodiscard]] std::string_view cookie_value(std::string_view header, std::string_view name);

}  // namespace docent::telepresence
