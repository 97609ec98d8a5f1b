// node kills.mjs [KILLS] [sqlite]: a server is killed again and again while visitors write; what it acknowledged is there.
import { spawnSync } from "node:child_process";
import { join } from "node:path";
import { Caller, Line, check, finish, folder, freePort, gateway, pause, postgres, uuid7 } from "./stage.mjs";

const kills = Number(process.argv[2] ?? 10);
const isFile = process.argv[3] === "sqlite";
const shared = isFile ? null : postgres();
const state = folder("kills");
const domain = process.env.DOCENT_TEST_DOMAIN ?? "69";
const settings = [
  "web.messages_per_second=10000", "web.message_burst=10000", "web.max_open_requests=1000000", "web.api.writes_per_second=10000",
  "web.api.reads_per_second=10000", "web.forum.posts_in_a_while=1000000",
];
const port = await freePort();
const rows = (table, column) => {
  if (shared) return shared.rows(`SELECT ${column} FROM ${table}`);
  const read = "import sqlite3,sys;[print(r[0]) for r in sqlite3.connect(sys.argv[1]).execute(sys.argv[2])]";
  const done = spawnSync("/usr/bin/python3", ["-c", read, join(state, "web.sqlite"), `SELECT ${column} FROM ${table}`], { encoding: "utf8", maxBuffer: 1 << 28 });
  if (done.status !== 0) throw new Error(done.stderr);
  return done.stdout.split("\n").filter(Boolean);
};

const acknowledged = { outbox: [], votes: [], posts: [] };
let visitor = null;
/** Writes until the server is gone. */
async function write(kind, one) {
  for (;;) {
    try {
      const id = await one();
      acknowledged[kind].push(id);
    } catch {
      return;
    }
  }
}
async function round() {
  const server = await gateway(port, domain, shared?.address, state, settings);
  visitor ??= new Caller(port);
  if (!visitor.cookie) await visitor.call("POST", "/visitor", { name: "Eve" });
  const line = new Line(port);
  await line.opened;
  const alive = (message) => {
    if (line.socket.readyState !== 1) throw new Error("gone");
    line.say(message);
    return new Promise((resolve, reject) => {
      const timer = setInterval(() => {
        if (line.answers.get(message.id)?.type === "ack") clearInterval(timer), resolve(undefined);
        else if (line.socket.readyState !== 1) clearInterval(timer), reject(new Error("gone"));
      }, 1);
    });
  };
  const before = Object.values(acknowledged).map((list) => list.length);
  const writing = [
    write("outbox", async () => {
      const id = uuid7();
      await alive({ type: "request", id, kind: "exhibit", target: "transrapid", viewpoint: -1, name: "", language: "en" });
      return id;
    }),
    write("votes", async () => {
      const voter = uuid7();
      await alive({ type: "vote", id: uuid7(), voter, tour: "highlights" });
      return voter;
    }),
    write("posts", async () => {
      const id = uuid7();
      await visitor.call("POST", "/forum", { id, title: "A title", text: "Some text." });
      return id;
    }),
  ];
  // It is killed while it writes: not before it has written something of each kind, however busy the machine is.
  const end = Date.now() + 20_000;
  while (Object.values(acknowledged).some((list, i) => list.length === before[i]) && Date.now() < end) await pause(5);
  await pause(150 + 250 * Math.random());
  await server.end("SIGKILL");
  await Promise.all(writing);
  line.close();
}
await check(`a server with ${shared ? "PostgreSQL" : "a file"} is killed ${kills} times while it writes`, async () => {
  for (let i = 0; i < kills; i++) await round();
});
for (const [table, column] of [["outbox", "id"], ["votes", "voter"], ["posts", "id"]]) {
  await check(`every acknowledged row of ${table} is there`, () => {
    const there = new Set(rows(table, column));
    const lost = acknowledged[table].filter((id) => !there.has(id));
    if (acknowledged[table].length < kills) throw new Error(`only ${acknowledged[table].length} were written`);
    if (lost.length > 0) throw new Error(`${lost.length} of ${acknowledged[table].length} lost: ${lost.slice(0, 3)}`);
    return `${acknowledged[table].length}`;
  });
}
await finish();
