#pragma once

#include <string>

#include "docent/base/result.h"
#include "docent/telepresence/api/endpoint.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/store/database.h"

namespace docent::modules {

/// Section `web`: the page and its server.
struct WebParams : telepresence::WebServerParams {
  std::string root;      ///< folder of the built page; empty: beside the program, else beside the sources
  std::string database;  ///< of wishes, votes, names, posts and counts: postgresql://…; empty: the file web.sqlite of
                         ///< the state folder
  double live_hz = 10.0;            ///< of what moves
  double pose_s = 0.3;              ///< between two poses of viewers who get these alone of what moves
  double belief_hz = 2.0;           ///< at most
  double resend_s = 1.0;            ///< requests that are not on the board yet
  double forget_hours = 24.0;       ///< after that a request is given up and forgotten
  int scan_step = 3;                ///< every n-th reading is shown
  int max_open_requests = 500;      ///< of everybody together; more are refused
  int kept_places = 20;             ///< of these for the hall's screen, its buttons and staff: the Web never takes them
  int max_open_of_address = 50;     ///< of whoever comes from one address over the Web
  telepresence::ApiParams api;      ///< logins, and how often somebody may call
  telepresence::ForumParams forum;  ///< what visitors may write
  template <class V>
  void visit(V& v) {
    telepresence::WebServerParams::visit(v);
    v("root", root);
    v("database", database);
    v("live_hz", live_hz);
    v("pose_s", pose_s);
    v("belief_hz", belief_hz);
    v("resend_s", resend_s);
    v("forget_hours", forget_hours);
    v("scan_step", scan_step);
    v("max_open_requests", max_open_requests);
    v("kept_places", kept_places);
    v("max_open_of_address", max_open_of_address);
    v("api", api);
    v("forum", forum);
  }
  [[nodiscard]] Result<void> validate() const {
    auto server = telepresence::WebServerParams::validate();
    if (!server) return server;
    if (auto valid = api.validate(); !valid) return valid;
    if (auto valid = forum.validate(); !valid) return valid;
    if (!database.empty() && !telepresence::Database::is_shared(database))
      return fail("web.database must be empty or postgresql://…");
    if (!(live_hz >= 1.0 && live_hz <= 60.0)) return fail("web.live_hz must be 1 to 60");
    if (!(pose_s >= 0.1 && pose_s <= 10.0)) return fail("web.pose_s must be 0.1 to 10");
    if (!(belief_hz >= 0.1 && belief_hz <= 20.0)) return fail("web.belief_hz must be 0.1 to 20");
    if (!(resend_s >= 0.05)) return fail("web.resend_s must be at least 0.05");
    if (!(forget_hours > 0.0)) return fail("web.forget_hours must be > 0");
    if (scan_step < 1 || scan_step > 90) return fail("web.scan_step must be 1 to 90");
    if (max_open_requests < 1) return fail("web.max_open_requests must be at least 1");
    if (kept_places < 0 || kept_places >= max_open_requests)
      return fail("web.kept_places must be less than web.max_open_requests");
    if (max_open_of_address < 1) return fail("web.max_open_of_address must be at least 1");
    return {};
  }
};

}  // namespace docent::modules
