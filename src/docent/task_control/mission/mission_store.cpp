#include "docent/task_control/mission/mission_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace docent::task_control {
namespace {

using Json = nlohmann::json;

// closed_rank: 0 while open; then counts up in the order of closing. travel_times came later: a file of before gets it
// when it is opened, empty.
constexpr const char* kSchema = R"(
  CREATE TABLE IF NOT EXISTS requests (
    arrival INTEGER PRIMARY KEY AUTOINCREMENT, id TEXT NOT NULL UNIQUE, stamp INTEGER NOT NULL, source TEXT NOT NULL,
    visitor TEXT NOT NULL, kind TEXT NOT NULL, target TEXT NOT NULL, viewpoint INTEGER NOT NULL,
    language TEXT NOT NULL, state TEXT NOT NULL, reason TEXT NOT NULL, created INTEGER NOT NULL,
    changed INTEGER NOT NULL, attempts INTEGER NOT NULL, not_before INTEGER NOT NULL, closed_rank INTEGER NOT NULL);
  CREATE INDEX IF NOT EXISTS requests_by_rank ON requests (closed_rank);
  CREATE TABLE IF NOT EXISTS facts (key TEXT PRIMARY KEY, value TEXT NOT NULL);
  CREATE TABLE IF NOT EXISTS travel_times (
    kind TEXT NOT NULL, from_place TEXT NOT NULL, to_place TEXT NOT NULL, count REAL NOT NULL, sum REAL NOT NULL,
    squares REAL NOT NULL, reference REAL NOT NULL, PRIMARY KEY (kind, from_place, to_place));
)";
constexpr std::uint64_t kTasksAfterALoss = 1000000;
constexpr const char* kColumns =
    "id, stamp, source, visitor, kind, target, viewpoint, language, state, reason, created, changed, attempts, "
    "not_before";

Json to_json(const Pose2& pose) { return {pose.x, pose.y, pose.theta.radians()}; }
Pose2 pose_from(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), Angle::radians(json.at(2).get<double>())};
}

Json to_json(const TourRun& tour) {
  Json stops = Json::array();
  for (const TourStop& stop : tour.stops) {
    stops.push_back({stop.exhibit_id, static_cast<int>(stop.status), stop.attempts, stop.number});
  }
  Json members = Json::array();
  for (const TourMember& member : tour.members) members.push_back({member.request_id, member.stops});
  return {{"id", tour.tour_id},
          {"language", tour.language},
          {"stops", stops},
          {"members", members},
          {"just_inserted", tour.just_inserted},
          {"target_s", tour.target_s},
          {"started", tour.started.nanoseconds},
          {"asks", tour.asks}};
}

/// Throws nlohmann::json::exception when something is missing.
TourRun tour_from(const Json& tour) {
  TourRun run;
  run.tour_id = tour.at("id").get<std::string>();
  run.language = tour.at("language").get<std::string>();
  run.just_inserted = tour.at("just_inserted").get<bool>();
  run.target_s = tour.at("target_s").get<double>();
  run.started = {tour.at("started").get<std::int64_t>()};
  for (const Json& stop : tour.at("stops")) {
    run.stops.push_back({stop.at(0).get<std::string>(),
                         static_cast<StopStatus>(std::clamp(stop.at(1).get<int>(), 0, 3)), stop.at(2).get<int>(),
                         stop.at(3).get<int>()});
  }
  for (const Json& member : tour.at("members"))
    run.members.push_back({member.at(0).get<std::string>(), member.at(1).get<std::vector<int>>()});
  run.asks = tour.value("asks", true);
  return run;
}

Json plan_of(const MissionMemory& memory) {
  Json plan;
  plan["next_task"] = memory.next_task;
  plan["must_charge"] = memory.must_charge;
  plan["planner"] = memory.planner;
  plan["revision"] = memory.schedule.board.revision();
  const Counters& counters = memory.schedule.counters;
  plan["counters"] = {counters.exhibits_explained, counters.tours_completed, counters.requests_served,
                      counters.tours_since_vote};
  const TaskOrder& task = memory.task;
  plan["task"] = {{"id", task.id},
                  {"kind", task.kind.text()},
                  {"exhibit", task.exhibit_id},
                  {"pose", to_json(task.map_from_base)},
                  {"language", task.language},
                  {"offer_more", task.offer_more},
                  {"tour", task.tour_id}};
  if (const auto& visit = memory.schedule.visit) {
    plan["visit"] = {
        {"exhibit", visit->exhibit_id}, {"viewpoint", visit->viewpoint}, {"pose", to_json(visit->map_from_base)},
        {"language", visit->language},  {"tour", visit->tour_id},        {"is_joinable", visit->is_joinable},
        {"asks", visit->asks},          {"is_point", visit->is_point},   {"started", visit->started.nanoseconds}};
  }
  if (const auto& tour = memory.schedule.tour) plan["tour"] = to_json(*tour);
  if (const auto& broken = memory.schedule.broken_tour) {
    plan["broken_tour"] = to_json(*broken);
    plan["broken_tour"]["broken_off"] = broken->broken_off.nanoseconds;
  }
  Json loads = Json::array();
  for (const Load& load : memory.schedule.loads) loads.push_back({load.at.nanoseconds, load.stops});
  plan["loads"] = loads;
  if (const auto& farewell = memory.schedule.farewell) {
    plan["farewell"] = {
        {"tour", farewell->tour_id}, {"language", farewell->language}, {"started", farewell->started.nanoseconds}};
  }
  return plan;
}

/// Throws nlohmann::json::exception when something is missing.
void read_plan(const Json& plan, MissionMemory& memory, std::uint64_t& revision) {
  memory.next_task = plan.at("next_task").get<std::uint64_t>();
  memory.must_charge = plan.value("must_charge", false);
  memory.planner = plan.value("planner", "");
  revision = plan.at("revision").get<std::uint64_t>();
  const Json& counters = plan.at("counters");
  memory.schedule.counters = {counters.at(0).get<std::uint32_t>(), counters.at(1).get<std::uint32_t>(),
                              counters.at(2).get<std::uint32_t>(),
                              counters.size() > 3 ? counters.at(3).get<std::uint32_t>() : 0};
  const Json& task = plan.at("task");
  memory.task = {task.at("id").get<std::string>(),       Word<TaskKind>{task.at("kind").get<std::string>()},
                 task.at("exhibit").get<std::string>(),  pose_from(task.at("pose")),
                 task.at("language").get<std::string>(), task.at("offer_more").get<bool>(),
                 task.at("tour").get<std::string>()};
  if (plan.contains("visit")) {
    const Json& visit = plan.at("visit");
    memory.schedule.visit = Visit{visit.at("exhibit").get<std::string>(),
                                  visit.value("viewpoint", -1),
                                  pose_from(visit.at("pose")),
                                  visit.at("language").get<std::string>(),
                                  visit.at("tour").get<std::string>(),
                                  visit.at("is_joinable").get<bool>(),
                                  {visit.at("started").get<std::int64_t>()},
                                  visit.value("asks", true),
                                  visit.value("is_point", false)};
  }
  if (plan.contains("tour")) memory.schedule.tour = tour_from(plan.at("tour"));
  if (plan.contains("broken_tour")) {
    memory.schedule.broken_tour = tour_from(plan.at("broken_tour"));
    memory.schedule.broken_tour->broken_off = {plan.at("broken_tour").at("broken_off").get<std::int64_t>()};
  }
  for (const Json& load : plan.value("loads", Json::array()))
    memory.schedule.loads.push_back({{load.at(0).get<std::int64_t>()}, load.at(1).get<int>()});
  if (plan.contains("farewell")) {
    const Json& farewell = plan.at("farewell");
    memory.schedule.farewell = Farewell{farewell.at("tour").get<std::string>(),
                                        farewell.at("language").get<std::string>(),
                                        {farewell.at("started").get<std::int64_t>()}};
  }
}

BoardEntry entry_from(SQLite::Statement& row) {
  BoardEntry entry;
  VisitorRequest& request = entry.request;
  request.id = row.getColumn(0).getString();
  request.stamp = {row.getColumn(1).getInt64()};
  request.source = Word<RequestSource>{row.getColumn(2).getString()};
  request.visitor = row.getColumn(3).getString();
  request.kind = Word<RequestKind>{row.getColumn(4).getString()};
  request.target = row.getColumn(5).getString();
  request.viewpoint = row.getColumn(6).getInt();
  request.language = row.getColumn(7).getString();
  entry.status = parse<RequestStatus>(row.getColumn(8).getString()).value_or(RequestStatus::failed);
  entry.reason = Reason::from_text(row.getColumn(9).getString());
  entry.created = {row.getColumn(10).getInt64()};
  entry.changed = {row.getColumn(11).getInt64()};
  entry.attempts = row.getColumn(12).getInt();
  entry.not_before = {row.getColumn(13).getInt64()};
  return entry;
}

}  // namespace

struct MissionStore::Connection {
  std::string name;
  SQLite::Database database;
  std::string saved_plan;
  std::string deployment;
  std::string set_aside;

  [[nodiscard]] tl::unexpected<Error> fault(const std::exception& why) const { return fail(name + ": " + why.what()); }
  [[nodiscard]] std::string fact(const std::string& key) {
    SQLite::Statement query{database, "SELECT value FROM facts WHERE key = ?"};
    query.bind(1, key);
    return query.executeStep() ? query.getColumn(0).getString() : "";
  }
  void set_fact(const std::string& key, const std::string& value) {
    SQLite::Statement insert{database, "INSERT OR REPLACE INTO facts (key, value) VALUES (?, ?)"};
    insert.bind(1, key);
    insert.bind(2, value);
    insert.exec();
  }
  /// How often the plan was lost, with this time.
  [[nodiscard]] std::uint64_t count_loss() {
    const std::uint64_t losses = std::strtoull(fact("losses").c_str(), nullptr, 10) + 1;
    set_fact("losses", std::to_string(losses));
    return losses;
  }
  void put(const LessonRow& row);
  [[nodiscard]] std::vector<LessonRow> lessons();
  void put(const BoardEntry& entry) {
    SQLite::Statement insert{
        database,
        "INSERT INTO requests (id, stamp, source, visitor, kind, target, viewpoint, language, state, reason, created, "
        "changed, attempts, not_before, closed_rank) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, "
        "?14, CASE WHEN ?15 THEN 0 ELSE (SELECT coalesce(max(closed_rank), 0) + 1 FROM requests) END) "
        "ON CONFLICT (id) DO UPDATE SET state = excluded.state, reason = excluded.reason, changed = excluded.changed, "
        "attempts = excluded.attempts, not_before = excluded.not_before, closed_rank = excluded.closed_rank"};
    const VisitorRequest& request = entry.request;
    insert.bind(1, request.id);
    insert.bind(2, request.stamp.nanoseconds);
    insert.bind(3, request.source.text());
    insert.bind(4, request.visitor);
    insert.bind(5, request.kind.text());
    insert.bind(6, request.target);
    insert.bind(7, request.viewpoint);
    insert.bind(8, request.language);
    insert.bind(9, std::string{to_text(entry.status)});
    insert.bind(10, entry.reason.text());
    insert.bind(11, entry.created.nanoseconds);
    insert.bind(12, entry.changed.nanoseconds);
    insert.bind(13, entry.attempts);
    insert.bind(14, entry.not_before.nanoseconds);
    insert.bind(15, is_open(entry.status) ? 1 : 0);
    insert.exec();
  }
};

void MissionStore::Connection::put(const LessonRow& row) {
  SQLite::Statement insert{database, "INSERT OR REPLACE INTO travel_times VALUES (?, ?, ?, ?, ?, ?, ?)"};
  insert.bind(1, to_text(row.key.kind));
  insert.bind(2, row.key.from);
  insert.bind(3, row.key.to);
  insert.bind(4, row.lesson.count);
  insert.bind(5, row.lesson.sum);
  insert.bind(6, row.lesson.squares);
  insert.bind(7, row.lesson.reference);
  insert.exec();
}

std::vector<LessonRow> MissionStore::Connection::lessons() {
  std::vector<LessonRow> rows;
  SQLite::Statement query{database,
                          "SELECT kind, from_place, to_place, count, sum, squares, reference FROM travel_times ORDER "
                          "BY kind, from_place, to_place"};
  while (query.executeStep()) {
    const auto kind = lesson_kind_of(query.getColumn(0).getString());
    if (!kind) continue;  // of a newer program
    rows.push_back({{*kind, query.getColumn(1).getString(), query.getColumn(2).getString()},
                    {query.getColumn(3).getDouble(), query.getColumn(4).getDouble(), query.getColumn(5).getDouble(),
                     query.getColumn(6).getDouble()}});
  }
  return rows;
}

MissionStore::MissionStore(std::unique_ptr<Connection> connection) : connection_{std::move(connection)} {}
MissionStore::MissionStore(MissionStore&&) noexcept = default;
MissionStore& MissionStore::operator=(MissionStore&&) noexcept = default;
MissionStore::~MissionStore() = default;

std::unique_ptr<MissionStore::Connection> MissionStore::connect(const std::filesystem::path& path,
                                                                const std::string& new_deployment, bool is_durable) {
  auto connection = std::make_unique<Connection>(Connection{
      path.string(), SQLite::Database{path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 2000}, "", "", ""});
  connection->database.exec(is_durable ? "PRAGMA synchronous = FULL" : "PRAGMA synchronous = OFF");
  connection->database.exec("PRAGMA journal_mode = WAL");
  SQLite::Transaction transaction{connection->database};
  connection->database.exec(kSchema);
  if (connection->fact("deployment").empty()) connection->set_fact("deployment", new_deployment);
  connection->deployment = connection->fact("deployment");
  SQLite::Statement check{connection->database,
                          std::string{"SELECT "} + kColumns + ", closed_rank FROM requests LIMIT 1"};
  check.executeStep();  // another program's file with tables of these names is no file of ours
  transaction.commit();
  return connection;
}

Result<MissionStore> MissionStore::open(const std::filesystem::path& path, const std::string& new_deployment,
                                        bool is_durable) {
  try {
    return MissionStore{connect(path, new_deployment, is_durable)};
  } catch (const SQLite::Exception& why) {
    const int code = why.getErrorCode();
    if (code != SQLITE_CORRUPT && code != SQLITE_NOTADB && code != SQLITE_ERROR)
      return fail(path.string() + ": " + why.what());
  } catch (const std::exception& why) {
    return fail(path.string() + ": " + why.what());
  }
  try {
    const std::filesystem::path aside = path.string() + ".damaged";
    for (const char* suffix : {"", "-wal", "-shm"}) {
      if (std::filesystem::exists(path.string() + suffix))
        std::filesystem::rename(path.string() + suffix, aside.string() + suffix);
    }
    auto connection = connect(path, new_deployment, is_durable);
    connection->set_aside = aside.string();
    return MissionStore{std::move(connection)};
  } catch (const std::exception& why) {
    return fail(path.string() + ": " + why.what());
  }
}

const std::string& MissionStore::set_aside() const { return connection_->set_aside; }

Result<MissionMemory> MissionStore::load() {
  try {
    MissionMemory memory;
    memory.deployment = connection_->deployment;
    std::uint64_t revision = 0;
    const std::string plan = connection_->fact("plan");
    try {
      if (!plan.empty()) read_plan(Json::parse(plan), memory, revision);
    } catch (const Json::exception&) {  // the requests are worth more than the step that was under way
      memory = {};
      memory.deployment = connection_->deployment;
      memory.next_task =
          kTasksAfterALoss * connection_->count_loss();  // ids that were given before must not come again
    }
    connection_->saved_plan = plan;
    memory.lessons = connection_->lessons();
    std::vector<BoardEntry> entries;
    const std::string columns = kColumns;
    SQLite::Statement open{connection_->database,
                           "SELECT " + columns + " FROM requests WHERE closed_rank = 0 ORDER BY arrival"};
    while (open.executeStep()) entries.push_back(entry_from(open));
    SQLite::Statement closed{connection_->database,
                             "SELECT " + columns +
                                 ", closed_rank FROM (SELECT * FROM requests WHERE closed_rank > 0 "
                                 "ORDER BY closed_rank DESC LIMIT " +
                                 std::to_string(RequestBoard::kClosedKept) + ") ORDER BY closed_rank"};
    while (closed.executeStep()) entries.push_back(entry_from(closed));
    memory.schedule.board.restore(std::move(entries), revision);
    return memory;
  } catch (const std::exception& why) {
    return connection_->fault(why);
  }
}

Result<void> MissionStore::save(const MissionMemory& memory) {
  try {
    std::string plan = plan_of(memory).dump();
    const auto& unstored = memory.schedule.board.unstored();
    if (unstored.empty() && memory.lessons.empty() && plan == connection_->saved_plan) return {};
    SQLite::Transaction transaction{connection_->database};
    for (const BoardEntry& entry : memory.schedule.board.entries()) {  // in this order: arrival and closing keep it
      if (unstored.contains(entry.request.id)) connection_->put(entry);
    }
    for (const LessonRow& row : memory.lessons) connection_->put(row);
    connection_->set_fact("plan", plan);
    transaction.commit();
    connection_->saved_plan = std::move(plan);
    return {};
  } catch (const std::exception& why) {
    return connection_->fault(why);
  }
}

Result<std::optional<BoardEntry>> MissionStore::find(const std::string& id) {
  try {
    SQLite::Statement query{connection_->database, std::string{"SELECT "} + kColumns + " FROM requests WHERE id = ?"};
    query.bind(1, id);
    if (!query.executeStep()) return std::optional<BoardEntry>{};
    return std::optional<BoardEntry>{entry_from(query)};
  } catch (const std::exception& why) {
    return connection_->fault(why);
  }
}

}  // namespace docent::task_control
