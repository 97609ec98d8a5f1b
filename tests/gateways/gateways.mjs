// Two gateways of one robot behind nginx, which share PostgreSQL.
import { spawnSync } from "node:child_process";
import { Caller, Line, check, docent, finish, folder, freePort, gateway, museum, nginx, pause, postgres, start, until, uuid7 } from "./stage.mjs";

const VIEWERS = 100;
const domain = process.env.DOCENT_TEST_DOMAIN ?? "67";
const database = postgres();
const PASSWORD = "a long way from Bonn";
for (const role of ["operator", "moderator"]) {
  const made = spawnSync(docent, ["web-account", "add", role, "--role", role, "--database", database.address], { input: `${PASSWORD}\n`, encoding: "utf8" });
  if (made.status !== 0) throw new Error(made.stderr);
}
const [first, second] = [await freePort(), await freePort()];
const generous = ["web.api.reads_per_second=100", "web.api.writes_per_second=100", "web.proxies=[127.0.0.1]"];
const robot = start(docent, [
  "up", "--sim", "--museum", museum, "--crowd", "quiet", "--requests-per-hour", "0", "--no-cameras", "--mode", "open", "--domain", domain, "--port", String(first),
  "--state", folder("first"), "--set", `web.database=${database.address}`, ...generous.flatMap((setting) => ["--set", setting]),
]);
await until("the first gateway", async () => {
  if (robot.code !== null) throw new Error(`docent up ended: ${robot.output}`);
  return fetch(`http://127.0.0.1:${first}/metrics`).then((reply) => reply.ok, () => false);
}, 60000);
let other = await gateway(second, domain, database.address, folder("second"), generous);
const front = await nginx([first, second]);
const here = new Line(first);
const there = new Line(second);
await Promise.all([here.opened, there.opened]);

await check("both show the robot", async () => {
  await until("poses", () => here.newest.live?.pose && there.newest.live?.pose && there.newest.mission, 300000);
});

await check("a request through one is seen through the other", async () => {
  const id = uuid7();
  const begin = Date.now();
  await there.ask({ type: "request", id, kind: "exhibit", target: await exhibit(), viewpoint: -1, name: "Ada", language: "en" });
  const key = id.slice(-8);
  const seen = (line) => line.newest.board && [...line.newest.board.open, ...line.newest.board.closed].some((entry) => entry.key === key && entry.visitor === "Ada");
  await until("it is on both boards", () => seen(here) && seen(there));
  return `${Date.now() - begin} ms`;
});
async function exhibit() {
  const known = await (await fetch(`http://127.0.0.1:${first}/api/museum.json`)).json();
  return known.exhibits.find((one) => !one.web_only).id;
}

await check("votes are counted together", async () => {
  const tour = (await (await fetch(`http://127.0.0.1:${first}/api/museum.json`)).json()).tours[0].id;
  await here.ask({ type: "vote", id: uuid7(), voter: uuid7(), tour });
  await there.ask({ type: "vote", id: uuid7(), voter: uuid7(), tour });
  const count = (line) => line.newest.votes?.tours.find(([id]) => id === tour)?.[1];
  await until("both count two", () => count(here) === 2 && count(there) === 2);
});

await check("a login and a post through one hold through the other", async () => {
  const eve = new Caller(front);
  await eve.call("POST", "/visitor", { name: "Eve" });
  const post = { id: uuid7(), title: "Two doors", text: "One hall." };
  const written = await eve.call("POST", "/forum", post);
  if (written.state !== "held") throw new Error(written.state);
  const moderator = new Caller(first);
  await moderator.call("POST", "/login", { name: "moderator", password: PASSWORD });
  await moderator.at(second).call("PUT", `/posts/${post.id}`, { state: "shown" });
  for (const port of [first, second, front]) {
    const seen = await new Caller(port).call("GET", `/forum/${post.id}`);
    if (seen.posts[0]?.text !== "One hall.") throw new Error(`${port}: ${JSON.stringify(seen)}`);
  }
});

await check("the stop button of one stops the robot, and the other shows it", async () => {
  const operator = new Caller(first);
  await operator.call("POST", "/login", { name: "operator", password: PASSWORD });
  const lines = [first, second].map((port) => new Line(port, "/operate", { Cookie: operator.cookie }));
  await Promise.all(lines.map((line) => line.opened));
  await lines[1].ask({ type: "stop", id: uuid7(), stopped: true });
  await until("both show it", () => lines.every((line) => line.newest.operation?.stopped));
  await until("it stands", () => here.newest.live.avoid?.reason?.word === "stopped_by_hand");
  await lines[0].ask({ type: "stop", id: uuid7(), stopped: false, number: lines[0].newest.operation.stop_number });
  await until("both show it", () => lines.every((line) => !line.newest.operation.stopped));
  lines.forEach((line) => line.close());
});

await check("a database that hangs holds up no operator, and whoever wishes is told", async () => {
  const operator = new Caller(first);
  await operator.call("POST", "/login", { name: "operator", password: PASSWORD });
  const target = await exhibit();
  const waits = [];
  database.hang(true);
  try {
    const wish = here.ask({ type: "request", id: uuid7(), kind: "exhibit", target, viewpoint: -1, name: "Ada", language: "en" });
    const refused = wish.then(() => Promise.reject(new Error("a wish was taken")), (why) => why.message);
    for (let i = 0; i < 5; ++i) {
      const line = new Line(first, "/operate", { Cookie: operator.cookie });
      const begin = Date.now();
      await line.opened;
      await until("the operation", () => line.newest.operation);
      for (const stopped of [true, false]) {
        const pressed = Date.now();
        await line.ask({ type: "stop", id: uuid7(), stopped, number: line.newest.operation.stop_number });
        waits.push(Date.now() - pressed);
        await until("it is shown", () => line.newest.operation.stopped === stopped);
      }
      if (Date.now() - begin > 5000) throw new Error("opening and stopping took more than 5 s");
      line.close();
    }
    if (!/not_stored/.test(await refused)) throw new Error(await refused);
  } finally {
    database.hang(false);
  }
  if (Math.max(...waits) > 1000) throw new Error(`a stop took ${Math.max(...waits)} ms`);
  await until("wishes are taken again", () => here.ask({ type: "request", id: uuid7(), kind: "exhibit", target, viewpoint: -1, name: "Ada", language: "en" }).then(() => true, () => false), 10000, 500);
  return `stops acted within ${Math.max(...waits)} ms`;
});

await check("whoever logs out at one gateway is gone from the other", async () => {
  const operator = new Caller(first);
  await operator.call("POST", "/login", { name: "operator", password: PASSWORD });
  const lines = [first, second].map((port) => new Line(port, "/operate", { Cookie: operator.cookie }));
  await Promise.all(lines.map((line) => line.opened));
  await lines[1].ask({ type: "lease", id: uuid7(), wants: true });
  await until("the lease is shown", () => lines[1].newest.operation?.holder === "operator");
  const begin = Date.now();
  const closed = lines.map((line) => new Promise((resolve) => line.socket.once("close", () => resolve(Date.now() - begin))));
  await operator.call("DELETE", "/login");
  const gone = await Promise.all(closed);
  const after = new Line(second, "/operate", { Cookie: operator.cookie });
  if (await after.opened.then(() => true, () => false)) throw new Error("their old cookie opens it again");
  if (Math.max(...gone) > 3000) throw new Error(`${gone} ms`);
  return `${gone[0]} ms here, ${gone[1]} ms there`;
});

/** A viewer as the page is one: when its line breaks it calls again after 0.3 s, then after longer pauses. */
class Viewer {
  last = Date.now();
  gap = 0;
  cuts = 0;
  constructor() {
    this.connect(0);
  }
  connect(tries) {
    const line = (this.line = new Line(front, "/live?thin"));
    line.socket.on("message", () => {
      this.gap = Math.max(this.gap, Date.now() - this.last);
      this.last = Date.now();
      tries = 0;
    });
    line.socket.on("close", () => {
      this.cuts += 1;
      if (!this.isEnded) setTimeout(() => this.connect(tries + 1), Math.min(10000, 300 * 2 ** tries) * (0.7 + 0.6 * Math.random()));
    });
  }
  end() {
    this.isEnded = true;
    this.line.close();
  }
}

await check("one gateway is killed: its viewers are back within 3 s", async () => {
  const figure = async (port) => Number((await (await fetch(`http://127.0.0.1:${port}/metrics`)).text()).match(/^docent_web_viewers (\d+)/m)[1]);
  const before = [await figure(first), await figure(second)];
  const viewers = Array.from({ length: VIEWERS }, () => new Viewer());
  await pause(3000);
  const [a, b] = [(await figure(first)) - before[0], (await figure(second)) - before[1]];
  if (Math.min(a, b) < VIEWERS / 4) throw new Error(`they are not spread: ${a} and ${b}`);
  for (const viewer of viewers) viewer.gap = viewer.cuts = 0;
  await other.end("SIGKILL");
  await pause(4000);
  const now = Date.now();
  const gaps = viewers.map((viewer) => Math.max(viewer.gap, now - viewer.last)).sort((x, y) => x - y);
  const hit = viewers.filter((viewer) => viewer.cuts > 0).length;
  viewers.forEach((viewer) => viewer.end());
  const longest = gaps[gaps.length - 1];
  if (longest > 3000) throw new Error(`the slowest heard nothing for ${longest} ms`);
  if (hit < b) throw new Error(`only ${hit} of ${b} were cut off`);
  return `${hit} of ${a + b} were cut off, the slowest heard nothing for ${longest} ms`;
});

await check("the gateway comes back and shows the same queue", async () => {
  other = await gateway(second, domain, database.address, folder("again"), generous);
  const again = new Line(second);
  await again.opened;
  await until("the board", () => again.newest.board && JSON.stringify(again.newest.board.open) === JSON.stringify(here.newest.board.open));
});
here.close();
await finish();
