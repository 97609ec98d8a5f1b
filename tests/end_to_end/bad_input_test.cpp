#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "program.h"

// Whatever a person gets wrong: one clear line that names file and line where there is a file, and a failing exit code.

namespace docent::bad_input_test {
namespace {

constexpr int kDomain = 44;
constexpr const char* kPort = "18044";
const std::string kMuseum = std::string{DOCENT_SOURCES} + "/museums/bonn";
const std::string kMap = kMuseum + "/map.yaml";

struct BadInput {
  const char* name;
  std::vector<std::string> arguments;
  std::string says;  ///< in its one line
};

/// One clear line, a failing exit code, and nothing was started before.
void expect_refused(const BadInput& bad) {
  SCOPED_TRACE(bad.name);
  const auto result = run_program(bad.arguments);
  EXPECT_NE(result.code, 0);
  EXPECT_NE(result.code, -1) << "it went on";
  EXPECT_LT(result.code, 128) << "it crashed";
  EXPECT_TRUE(result.output.starts_with("docent: ") || result.output.starts_with("docent-lab: ")) << result.output;
  EXPECT_NE(result.output.find(bad.says), std::string::npos) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

/// `docent up` with these options, and those that are needed where they are missing.
std::vector<std::string> up_with(std::vector<std::string> more, const std::filesystem::path& state) {
  more.insert(more.begin(), {"up", "--domain", std::to_string(kDomain)});
  const auto has = [&](const char* option) { return std::find(more.begin(), more.end(), option) != more.end(); };
  if (!has("--museum")) more.insert(more.end(), {"--museum", kMuseum});
  if (!has("--state")) more.insert(more.end(), {"--state", state});
  if (!has("--port")) more.insert(more.end(), {"--port", kPort});
  return more;
}

/// Another program's port.
class TakenPort {
 public:
  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    number_ = ntohs(address.sin_port);
  }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  ~TakenPort() { close(socket_); }
  [[nodiscard]] std::string number() const { return std::to_string(number_); }

 private:
  int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int number_ = 0;
};

TEST(BadInput, UpSaysWhichOptionIsWrongBeforeAnythingStarts) {
  const TemporaryFolder folder;
  const auto with = [&](std::vector<std::string> more) { return up_with(std::move(more), folder.path() / "state"); };
  const TakenPort port;
  for (const auto& bad : std::vector<BadInput>{
           {"port in use", with({"--port", port.number()}), "Address already in use"},
           {"no museum", with({"--museum", "/nowhere"}), "/nowhere: there is no such folder"},
           {"no robot.yaml", with({"--robot", "/nowhere.yaml"}), "/nowhere.yaml"},
           {"crowd of a real museum", with({"--crowd", "busy"}), "--crowd is of a simulated museum: it needs --sim"},
           {"crippled by --set", with({"--set", "evaluation.blind_to_people=yes"}),
            "section evaluation cripples the robot, which docent-lab alone does"},
           {"a simulated robot crippled", with({"--sim", "--set", "evaluation.without_watches=on"}), "docent-lab"},
           {"--set without value", with({"--set", "plan"}), "--set plan: expected section.key=value"},
           {"--set of a body that cannot be", with({"--set", "body.colour=red"}), "colour"},
           {"--set of an unknown section", with({"--set", "flying.height=3"}), "unknown section 'flying'"},
           {"port out of range", with({"--port", "70000"}), "--port"},
           {"port of no number", with({"--port", "web"}), "--port"},
           {"domain out of range", with({"--domain", "231"}), "--domain"},
           {"state cannot be made", with({"--state", "/proc/docent"}), "--state /proc/docent: "},
           {"recording into nothing", with({"--record", "/nowhere/a.mcap"}),
            "--record: cannot write /nowhere/a.mcap: there is no folder /nowhere"},
           {"start that is no pose", with({"--sim", "--start", "1,2"}), "--start"},
           {"start in the street", with({"--sim", "--start", "1000,1000,0"}), "outside the robot's area"},
           {"no scenario", with({"--sim", "--scenario", "/nowhere.yaml"}), "/nowhere.yaml"},
           {"unknown mode", with({"--mode", "upside-down"}), "--mode upside-down"},
           {"unknown crowd", with({"--crowd", "enormous"}), "--crowd"},
           {"unknown option", with({"--fly"}), "--fly"},
       }) {
    expect_refused(bad);
  }
}

TEST(BadInput, UpSaysWhichLineOfAFileIsWrongBeforeAnythingStarts) {
  const TemporaryFolder folder;
  const auto with = [&](std::vector<std::string> more) { return up_with(std::move(more), folder.path() / "state"); };
  const std::string key = folder.write("key.yaml", "plan: {}\nbody:\n  radius: 0.3\n  colour: red\n");
  const std::string section = folder.write("section.yaml", "plan: {}\nflying: {height: 3}\n");
  const std::string crippled = folder.write("crippled.yaml", "plan: {}\nevaluation:\n  dead_reckoning: y\n");
  const std::string type = folder.write("type.yaml", "body:\n  radius: wide\n");
  const std::string syntax = folder.write("syntax.yaml", "body: [1, 2\nplan: }\n");
  const std::string list = folder.write("list.yaml", "- 1\n- 2\n");
  const std::string scenario = folder.write("scenario.yaml", "events:\n  - at: 3\n    dance: {}\n");
  const std::string file = folder.write("file", "");
  const std::string broken = folder.write("museum.yaml", "name: {en: \"Broken\"\nmap: 3\n");
  for (const auto& bad : std::vector<BadInput>{
           {"broken museum", with({"--museum", folder.path()}), broken + ":"},
           {"unknown key", with({"--robot", key}), "key.yaml:4: "},
           {"unknown section", with({"--robot", section}), "section.yaml:2: unknown section 'flying' (known: body, "},
           {"wrong type", with({"--robot", type}), "type.yaml:2: "},
           {"bad syntax", with({"--robot", syntax}), "syntax.yaml:"},
           {"no sections", with({"--robot", list}), "list.yaml:1: "},
           {"crippled by robot.yaml", with({"--robot", crippled}),
            "crippled.yaml:3: section evaluation cripples the robot"},
           {"state is a file", with({"--state", file}), "--state"},
           {"unknown event", with({"--sim", "--scenario", scenario}), "scenario.yaml:3: "},
       }) {
    expect_refused(bad);
  }
}

TEST(BadInput, NoModuleRunsCrippled) {
  const TemporaryFolder folder;
  const std::string crippled = folder.write("crippled.yaml", "evaluation: {best_pose_error_x: 1.0}\n");
  for (const char* module : {"avoid", "sim"}) {
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"run", module, "--domain", std::to_string(kDomain), "--museum", kMuseum, "--state",
                                 folder.path() / "state"});
      return more;
    };
    expect_refused({module, with({"--set", "evaluation.ignores_hazards=on"}), "docent-lab"});
    expect_refused({module, with({"--robot", crippled}), "crippled.yaml:1: section evaluation cripples the robot"});
  }
}

/// Maps and logs.
class BadFiles : public testing::Test {
 protected:
  std::string map(const std::string& name, const std::string& image, const std::string& more = "") {
    return folder.write(name, "image: " + image + "\nresolution: 0.05\norigin: [0, 0, 0]\n" + more);
  }
  TemporaryFolder folder;
};

TEST_F(BadFiles, PlansInMaps) {
  const std::string no_image = map("no_image.yaml", "none.pgm");
  folder.write("short.pgm", "P5\n3 3\n255\nabc");
  const std::string cut_image = map("cut_image.yaml", "short.pgm");
  folder.write("text.pgm", "a picture");
  const std::string no_picture = map("no_picture.yaml", "text.pgm");
  folder.write("good.pgm", "P5\n2 2\n255\nabcd");
  const std::string bad_key = map("bad_key.yaml", "good.pgm", "colour: 3\n");
  const std::string no_size = folder.write("no_size.yaml", "image: good.pgm\nresolution: 0\norigin: [0, 0, 0]\n");
  const std::string no_origin = folder.write("no_origin.yaml", "image: good.pgm\nresolution: 0.05\norigin: [0]\n");
  const std::string no_yaml = folder.write("no_yaml.yaml", "image: [good.pgm\n");
  for (const auto& bad : std::vector<BadInput>{
           {"map without image", {"plan", "--map", no_image, "--from", "0,0", "--to", "1,1"}, "no_image.yaml:1: "},
           {"image cut", {"plan", "--map", cut_image, "--from", "0,0", "--to", "1,1"}, "short.pgm:"},
           {"image is text", {"plan", "--map", no_picture, "--from", "0,0", "--to", "1,1"}, "text.pgm"},
           {"unknown key of a map", {"plan", "--map", bad_key, "--from", "0,0", "--to", "1,1"}, "bad_key.yaml:4: "},
           {"map without size", {"plan", "--map", no_size, "--from", "0,0", "--to", "1,1"}, "no_size.yaml:2: "},
           {"map without place", {"plan", "--map", no_origin, "--from", "0,0", "--to", "1,1"}, "no_origin.yaml:3: "},
           {"map is no YAML", {"plan", "--map", no_yaml, "--from", "0,0", "--to", "1,1"}, "no_yaml.yaml:"},
           {"no map", {"plan", "--map", "/nowhere.yaml", "--from", "0,0", "--to", "1,1"}, "/nowhere.yaml"},
           {"plan from a wall", {"plan", "--map", kMap, "--from", "0,0", "--to", "9,3.6"}, "--from 0,0: "},
           {"plan to nowhere", {"plan", "--map", kMap, "--from", "9,3.6", "--to", "900,3"}, "--to 900,3: "},
           {"point of one number", {"plan", "--map", kMap, "--from", "9", "--to", "1,1"}, "--from 9: "},
           {"plan without map", {"plan", "--from", "9,3", "--to", "1,1"}, "either --map or --museum is needed"},
       }) {
    expect_refused(bad);
  }
}

TEST_F(BadFiles, Pictures) {
  for (const auto& bad : std::vector<BadInput>{
           {"picture of another kind",
            {"plan", "--map", kMap, "--from", "9,3.6", "--to", "9,3.6", "--picture", "way.jpg"},
            "--picture: way.jpg: the name of a picture must end in .svg, .pdf or .png"},
           {"picture without a kind", {"simulate", "--picture", "way"}, "must end in .svg, .pdf or .png"},
           {"picture in no folder",
            {"simulate", "--picture", "/nowhere/way.svg"},
            "--picture: cannot write /nowhere/way.svg: there is no folder /nowhere"},
           {"format of pictures",
            {"office", "--out", folder.path() / "o", "--picture-format", "jpg"},
            "--picture-format"},
       }) {
    expect_refused(bad);
  }
}

TEST_F(BadFiles, LogsToLocalizeAndMap) {
  const std::string no_image = map("no_image.yaml", "none.pgm");
  const std::string no_text = folder.write("no_text.yaml", std::string{"\x89PNG\0\0", 6});
  const std::string text = folder.write("text.log", "hello\n");
  const std::string cut_line = folder.write("cut.log", "# a comment\nFLASER 3 1.0 2.0\n");
  const std::string standing = folder.write("standing.log", "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 1 host 1\n");
  const std::string no_number = folder.write("letters.log", "FLASER 2 1.0 x 0 0 0 0 0 0 1 host 1\n");
  const std::string no_gzip = folder.write("no.gz", "\x1f\x8b nonsense");
  for (const auto& bad : std::vector<BadInput>{
           {"no log", {"localize", "--map", kMap, "--log", "/nowhere.log"}, "/nowhere.log: "},
           {"log without scans", {"localize", "--map", kMap, "--log", text}, "text.log: "},
           {"line cut", {"localize", "--map", kMap, "--log", cut_line}, "cut.log:2: "},
           {"letters for a range", {"localize", "--map", kMap, "--log", no_number}, "letters.log:1: "},
           {"damaged gzip", {"localize", "--map", kMap, "--log", no_gzip}, "no.gz"},
           {"localize in no map", {"localize", "--map", no_image, "--log", text}, "no_image.yaml:1: "},
           {"map of no pose",
            {"map", "--log", standing, "--method", "known-poses", "--out", folder.path() / "m"},
            "--reference"},
           {"map of bad poses",
            {"map", "--log", standing, "--reference", text, "--out", folder.path() / "m"},
            "text.log:1: "},
           {"unknown scans", {"map", "--log", standing, "--scans", "some", "--out", "m"}, "--scans"},
           {"no key of the mapper",
            {"map", "--log", standing, "--reference", "logged", "--set", "colour=1", "--out", folder.path() / "m"},
            "colour"},
           {"start without a reference",
            {"localize", "--map", kMap, "--log", standing, "--start", "reference"},
            "--reference"},
           {"a picture for a map", {"localize", "--map", no_text, "--log", standing}, "is no text file"},
           {"unknown method", {"localize", "--map", kMap, "--log", text, "--method", "magic"}, "--method"},
       }) {
    expect_refused(bad);
  }
}

TEST_F(BadFiles, Learning) {
  const std::string no_image = map("no_image.yaml", "none.pgm");
  const std::string cut_line = folder.write("cut.log", "# a comment\nFLASER 3 1.0 2.0\n");
  const std::string standing = folder.write("standing.log", "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 1 host 1\n");
  for (const auto& bad : std::vector<BadInput>{
           {"walls of no depth",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--wall-depth", "deep"},
            "--wall-depth deep: expected auto or a number"},
           {"learn from no log", {"learn-sensor-model", "--map", kMap, "--log", "/nowhere.log"}, "/nowhere.log: "},
           {"learn without log", {"learn-sensor-model", "--map", kMap}, "--log is required"},
           {"learn from a line cut", {"learn-sensor-model", "--map", kMap, "--log", cut_line}, "cut.log:2: "},
           {"learn without map", {"learn-sensor-model", "--log", standing}, "either --map or --museum is required"},
           {"learn in two maps",
            {"learn-sensor-model", "--map", kMap, "--museum", kMuseum, "--log", standing},
            "either --map or --museum is required"},
           {"learn in no map", {"learn-sensor-model", "--map", no_image, "--log", standing}, "no_image.yaml:1: "},
           {"learn in no museum",
            {"learn-sensor-model", "--museum", "/nowhere", "--log", standing},
            "/nowhere: there is no such folder"},
           {"learn an unknown sensor",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--sensor", "nose"},
            "--sensor"},
           {"learn sonar from a laser's log",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--sensor", "sonar"},
            "standing.log: holds no readings of sonars with a place"},
           {"learn into nothing",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--out", "/nowhere/robot.yaml"},
            "--out: cannot write /nowhere/robot.yaml: there is no folder /nowhere"},
           {"learn with an unknown key",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--set", "colour=3"},
            "colour"},
           {"learn with walls of letters",
            {"learn-sensor-model", "--map", kMap, "--log", standing, "--wall-depth", "deep"},
            "--wall-depth deep: "},
       }) {
    expect_refused(bad);
  }
}

TEST_F(BadFiles, Recordings) {
  const std::string text = folder.write("text.log", "hello\n");
  const std::string no_mcap = folder.write("no.mcap", "\x89MCAP");
  const std::string empty = folder.write("empty.mcap", "");
  for (const auto& bad : std::vector<BadInput>{
           {"recording cut in its magic", {"evaluate", no_mcap}, "no.mcap: "},
           {"empty recording", {"evaluate", empty}, "empty.mcap: "},
           {"no recording", {"evaluate", "/nowhere.mcap"}, "/nowhere.mcap: "},
           {"replay of a text", {"replay", text}, "text.log: "},
           {"replay of nothing", {"replay", "/nowhere.mcap"}, "/nowhere.mcap: "},
       }) {
    expect_refused(bad);
  }
}

TEST(BadInput, Simulations) {
  const TemporaryFolder folder;
  const std::string no_list = folder.write("no_list.yaml", "events: 3\n");
  const std::string no_event = folder.write("no_event.yaml", "events:\n  - {at: 3, dance: {}}\n");
  const std::string no_time = folder.write("no_time.yaml", "events:\n  - {kidnap: {}}\n");
  const std::string no_sensor =
      folder.write("no_sensor.yaml", "events:\n  - {at: 1, fault: {sensor: nose, kind: dead}}\n");
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", "--museum", kMuseum, "--hours", "0.001"});
    return more;
  };
  for (const auto& bad : std::vector<BadInput>{
           {"no museum", {"simulate", "--museum", "/nowhere", "--hours", "1"}, "/nowhere: there is no such folder"},
           {"no time", {"simulate", "--museum", kMuseum, "--hours", "-1"}, "--hours"},
           {"no scenario", with({"--scenario", "/nowhere.yaml"}), "/nowhere.yaml: "},
           {"scenario without a list", with({"--scenario", no_list}), "no_list.yaml:1: "},
           {"unknown event", with({"--scenario", no_event}), "no_event.yaml:2: "},
           {"event without time", with({"--scenario", no_time}), "no_time.yaml:2: "},
           {"unknown sensor", with({"--scenario", no_sensor}), "no_sensor.yaml:2: "},
           {"unknown crowd", with({"--crowd", "many"}), "--crowd"},
           {"fewer people than none", with({"--people", "-3"}), "--people"},
           {"seed below the first", with({"--seed", "-3"}), "'-3' is no whole number from 0 on"},
           {"start that is no pose", with({"--start", "wall"}), "--start wall: "},
           {"report into nothing", with({"--report", "/nowhere/report.json"}), "/nowhere/report.json"},
           {"recording into nothing", with({"--record", "/nowhere/run.mcap"}), "/nowhere/run.mcap"},
           {"unknown setting", with({"--set", "plan.wings=2"}), "--set plan.wings=2:"},
           {"misspelt setting", with({"--set", "map.sonar.reech=1"}),
            "--set map.sonar.reech=1: unknown key 'reech'; did you mean 'reach'? (known: "},
           {"misspelt section", with({"--set", "mapp.reach=1"}), "unknown section 'mapp'; did you mean 'map'?"},
           {"misspelt museum",
            {"simulate", "--museum", kMuseum.substr(0, kMuseum.size() - 1)},
            "/bon: there is no such folder; did you mean 'bonn'? (museums in "},
           {"misspelt command", {"simulatee"}, "unknown command 'simulatee'; did you mean 'simulate'?"},
           {"setting out of range", with({"--set", "avoid.cycle=-1"}), "--set avoid.cycle=-1"},
           {"unknown mode", with({"--mode", "upside-down"}), "--mode upside-down"},
           {"unknown module", {"run", "nothing"}, "no module 'nothing'"},
           {"unknown command", {"fly"}, "unknown command 'fly'"},
           {"a crippled robot", with({"--set", "evaluation.blind_to_people=on"}), "docent-lab"},
           {"no command", {}, "subcommand"},
       }) {
    expect_refused(bad);
  }
}

TEST(BadInput, CrowdsAndMuseumsToBeMade) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "made";
  folder.write("tiny.pgm", "P5\n2 2\n255\nabcd");
  const std::string tiny = folder.write("tiny.yaml", "image: tiny.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  const std::string file = folder.write("file", "");
  const std::string tracks = folder.write("tracks.txt", "1 2\n");
  for (const auto& bad : std::vector<BadInput>{
           {"too dense a crowd", {"crowd", "--density", "9"}, "--density must lie between 0 and 3"},
           {"a crowd of no number", {"crowd", "--density", "nan"}, "--density must lie between 0 and 3"},
           {"more than all", {"crowd", "--ignoring", "2"}, "--ignoring must lie between 0 and 1"},
           {"unknown method", {"crowd", "--method", "teleport"}, "--method"},
           {"unknown setting", {"crowd", "--set", "avoid.wings=2"}, "unknown key 'wings'"},
           {"score into nothing", {"crowd", "--density", "0", "--report", "/nowhere/x.json"}, "/nowhere/x.json"},
           {"no map", {"museum", "/nowhere.yaml", "--out", out}, "/nowhere.yaml"},
           {"no folder to make", {"museum", kMap}, "--out is required"},
           {"folder in a file", {"museum", kMap, "--out", file + "/x"}, "file is not a folder"},
           {"no room", {"museum", tiny, "--out", out}, "tiny.yaml: the map has no open floor"},
           {"unknown recording", {"museum", kMap, "--out", out, "--pedestrians", "nobody"}, "--pedestrians nobody"},
           {"recording cut", {"museum", kMap, "--out", out, "--pedestrians", tracks}, "tracks.txt:1: "},
       }) {
    expect_refused(bad);
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(MadeMuseum, IsFitToDriveInWhateverItsTitle) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "made";
  const auto made = run_program({"museum", kMap, "--out", out, "--seed", "3", "--title", "The \"old\" mill"});
  EXPECT_EQ(made.code, 0) << made.output;
  EXPECT_NE(made.output.find(" exhibits, "), std::string::npos) << made.output;
  const auto checked = run_program({"check", out});
  EXPECT_EQ(checked.code, 0) << checked.output;
  const auto driven = run_program({"simulate", "--museum", out, "--hours", "0.002", "--seed", "1", "--quiet"});
  EXPECT_EQ(driven.code, 0) << driven.output;
}

struct BrokenMuseum {
  std::string folder;
  std::string line;  ///< of museum.yaml, that was changed
};
BrokenMuseum broken_museum(const TemporaryFolder& folder, const std::string& name, const std::string& what,
                           const std::string& by) {
  const auto copy = folder.path() / name;
  std::filesystem::copy(kMuseum, copy, std::filesystem::copy_options::recursive);
  std::stringstream text;
  text << std::ifstream{copy / "museum.yaml"}.rdbuf();
  std::string content = text.str();
  const auto place = content.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  content.replace(place, what.size(), by);
  std::ofstream{copy / "museum.yaml"} << content;
  return {copy, std::to_string(line)};
}

TEST(BadInput, Museums) {
  const TemporaryFolder folder;
  struct Change {
    const char* name;
    const char* what;
    const char* by;
    const char* says;
  };
  for (const auto& change : std::vector<Change>{
           {"unknown-key", "home: {x: 9.0", "house: {x: 9.0", "museum.yaml:LINE: unknown key 'house'"},
           {"home-in-the-street", "home: {x: 9.0", "home: {x: 900.0", "museum.yaml:LINE: "},
           {"unknown-kind", "kind: plate", "kind: carpet", "museum.yaml:LINE: "},
           {"no-polygon", "[[20.96, 2.78], [24.64, 2.78], [24.64, 5.23], [20.96, 5.23]]", "[[20.96, 2.78]]",
            "museum.yaml:LINE: "},
           {"no-map", "map: map.yaml", "map: none.yaml", "museum.yaml:LINE: none.yaml does not exist"},
           {"no-text", "content/zuse.short.en.md", "content/none.md", "museum.yaml:"},
           {"exhibit-in-a-wall", "pose: {x: 15.5, y: 5.0", "pose: {x: 0.1, y: 0.1", "museum.yaml:"},
           {"tour-to-nothing", "exhibits: [lithotripter", "exhibits: [unicorn", "unicorn"},
           {"twins", "- id: zuse", "- id: crew", "exhibit 'crew' stands twice"},
           {"no-number", "heading: 171", "heading: west", "museum.yaml:"},
           {"no-simulation", "simulation: simulation.yaml", "simulation: none.yaml", "museum.yaml:"},
       }) {
    SCOPED_TRACE(change.name);
    const auto broken = broken_museum(folder, change.name, change.what, change.by);
    std::string says = change.says;
    if (const auto at = says.find("LINE"); at != std::string::npos) says.replace(at, 4, broken.line);
    const auto result = run_program({"check", broken.folder});
    EXPECT_EQ(result.code, 1) << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
    EXPECT_NE(result.output.find(" fault"), std::string::npos) << result.output;
  }
}

}  // namespace
}  // namespace docent::bad_input_test
