// A gateway far away: one line of 256 kbit/s from the museum, and viewers who get the pose every 0.3 s and a picture every 5 s.
import { readFileSync, writeFileSync } from "node:fs";
import { createServer, connect } from "node:net";
import { join } from "node:path";
import { Caller, Line, check, docent, finish, folder, freePort, museum, pause, start, until, uuid7 } from "./stage.mjs";

const RATE = 256000 / 8; // [bytes/s] each way
const DELAY = 40; // [ms] each way
const VIEWERS = 200;
const SECONDS = Number(process.argv[2] ?? 30);
const domain = process.env.DOCENT_TEST_DOMAIN ?? "71";

/** A line that carries so much and no more, with a short queue, as a radio link has: a port that leads to `port`. */
async function thinLine(port) {
  const figures = { down: 0, up: 0, isCut: false, seen: "" };
  const lines = new Set();
  const pipe = (from, to, way) => {
    let free = 0; // [ms] when the line is free again
    let queued = 0;
    from.on("data", (bytes) => {
      queued += bytes.length;
      if (queued > 4096) from.pause();
      free = Math.max(free, performance.now()) + (bytes.length / RATE) * 1000;
      setTimeout(() => {
        figures[way] += bytes.length;
        if (figures.seen.length < 1e6) figures.seen += bytes.toString("latin1");
        queued -= bytes.length;
        if (!figures.isCut) to.write(bytes);
        from.resume();
      }, free - performance.now() + DELAY);
    });
    from.on("error", () => to.destroy());
    from.on("close", () => to.destroy());
  };
  const server = createServer({ highWaterMark: 2048 }, (near) => {
    const far = connect({ port, host: "127.0.0.1", highWaterMark: 2048 });
    lines.add(near).add(far);
    pipe(near, far, "up");
    pipe(far, near, "down");
  });
  const at = await freePort();
  await new Promise((resolve) => server.listen(at, "127.0.0.1", resolve));
  figures.port = at;
  figures.cut = () => lines.forEach((line) => line.destroy());
  return figures;
}

const state = folder("museum");
const here = await freePort();
const door = await freePort();
const robot = start(docent, ["up", "--set", `web.uplink_port=${door}`, "--sim", "--museum", museum, "--crowd", "busy", "--mode", "open", "--domain", domain, "--port", String(here), "--state", state]);
await until("the robot", async () => {
  if (robot.code !== null) throw new Error(`docent up ended: ${robot.output}`);
  return fetch(`http://127.0.0.1:${here}/metrics`).then((reply) => reply.ok, () => false);
}, 60000);
await until("a picture", () => fetch(`http://127.0.0.1:${here}/camera/scene.jpg`).then((reply) => reply.status === 200), 60000);
const line = await thinLine(door);
const far = await freePort();
const begun = Date.now();
const gateway = start(docent, ["gateway", "--from", `127.0.0.1:${line.port}`, "--key", join(state, "uplink.key"), "--port", String(far)]);
await until("the far gateway", async () => {
  if (gateway.code !== null) throw new Error(`docent gateway ended: ${gateway.output}`);
  return fetch(`http://127.0.0.1:${far}/metrics`).then((reply) => reply.ok, () => false);
}, 120000);
console.log(`        the far gateway began after ${((Date.now() - begun) / 1000).toFixed(1)} s and ${Math.round(line.down / 1000)} kB`);

const viewers = Array.from({ length: VIEWERS }, () => new Line(far));
await Promise.all(viewers.map((viewer) => viewer.opened));
await until("poses", () => viewers.every((viewer) => viewer.newest.pose), 30000);

await check(`${VIEWERS} viewers get a position every 0.3 s and a picture every 5 s for ${SECONDS} s, over 256 kbit/s`, async () => {
  const gaps = [];
  const ages = [];
  for (const viewer of viewers) {
    let last = 0;
    viewer.socket.on("message", (text) => {
      const message = JSON.parse(text);
      if (message.type !== "pose") return;
      const now = performance.now();
      if (last > 0) gaps.push(now - last);
      last = now;
      ages.push(Date.now() / 1000 - message.t);
    });
  }
  const pictures = { robot: new Set(), scene: new Set() };
  const before = line.down;
  for (const end = Date.now() + SECONDS * 1000; Date.now() < end; await pause(500)) {
    for (const name of ["robot", "scene"]) {
      const reply = await fetch(`http://127.0.0.1:${far}/camera/${name}.jpg`);
      if (reply.status !== 200) continue;
      const bytes = new Uint8Array(await reply.arrayBuffer());
      if (bytes[0] !== 0xff || bytes[bytes.length - 1] !== 0xd9) throw new Error("a picture is cut short");
      pictures[name].add(reply.headers.get("docent-taken"));
    }
  }
  const used = ((line.down - before) * 8) / SECONDS / 1000;
  gaps.sort((a, b) => a - b);
  ages.sort((a, b) => a - b);
  const at = (list, share) => list[Math.floor(share * (list.length - 1))];
  const mean = (SECONDS * 1000 * VIEWERS) / gaps.length;
  if (mean > 315) throw new Error(`a pose every ${mean.toFixed(0)} ms`);
  if (at(gaps, 0.99) > 450) throw new Error(`1 % of the gaps are over ${at(gaps, 0.99).toFixed(0)} ms`);
  if (at(ages, 0.99) > 0.6) throw new Error(`1 % of the poses are over ${at(ages, 0.99).toFixed(2)} s old`);
  const least = Math.floor(SECONDS / 5) - 1;
  for (const [name, set] of Object.entries(pictures)) if (set.size < least) throw new Error(`${set.size} pictures of ${name}, at least ${least} were due`);
  if (used > 256) throw new Error(`${used} kbit/s`);
  return `a pose every ${mean.toFixed(0)} ms (99 %: ${at(gaps, 0.99).toFixed(0)} ms, ${(at(ages, 0.99) * 1000).toFixed(0)} ms old), ${pictures.robot.size} and ${pictures.scene.size} pictures, ${used.toFixed(0)} kbit/s`;
});

await check("a viewer far away asks, and the museum answers", async () => {
  const exhibits = (await (await fetch(`http://127.0.0.1:${far}/api/museum.json`)).json()).exhibits;
  const id = uuid7();
  await viewers[0].ask({ type: "request", id, kind: "exhibit", target: exhibits.find((one) => !one.web_only).id, viewpoint: -1, name: "Far away", language: "en" });
  await until("it is on the board", () => viewers[1].newest.board && [...viewers[1].newest.board.open, ...viewers[1].newest.board.closed].some((entry) => entry.key === id.slice(-8)));
});
await check("the forum is the museum's; operators must be nearer", async () => {
  const eve = new Caller(far);
  await eve.call("POST", "/visitor", { name: "Eve" });
  const post = { id: uuid7(), title: "From far away", text: "Hello!" };
  await eve.call("POST", "/forum", post);
  const own = await eve.at(here).call("GET", `/forum/${post.id}`);
  if (own.posts[0]?.text !== "Hello!") throw new Error(JSON.stringify(own));
  const operator = new Line(far, "/operate", { Cookie: eve.cookie });
  await operator.opened.then(
    () => Promise.reject(new Error("an operator's line was opened")),
    () => undefined,
  );
});
await check("what does not fit the line is refused at once, and the line stays", async () => {
  const long = await fetch(`http://127.0.0.1:${far}/api/v1/forum?before=${"1".repeat(5000)}`);
  if (long.status !== 414) throw new Error(`a long address: ${long.status}`);
  const odd = await Promise.all(Array.from({ length: 50 }, () => fetch(`http://127.0.0.1:${far}/api/v1/forum?before=1`, { headers: { Cookie: `docent_login=${"x".repeat(5000)}` } })));
  if (odd.some((reply) => ![200, 429, 503].includes(reply.status))) throw new Error(`${odd.map((reply) => reply.status)}`);
  const large = await fetch(`http://127.0.0.1:${far}/api/v1/museum`, { method: "PUT", headers: { "Content-Type": "application/json" }, body: " ".repeat(70000) }).then((reply) => reply.status, () => 403);
  if (large !== 403) throw new Error(`a museum: ${large}`);
  const operator = await fetch(`http://127.0.0.1:${far}/api/v1/login`, { method: "POST", headers: { "Content-Type": "application/json" }, body: '{"name":"a","password":"b"}' });
  if (operator.status !== 403) throw new Error(`a login: ${operator.status}`);
  const before = viewers[7].newest.pose.t;
  await until("the line goes on", () => viewers[7].newest.pose.t > before);
});
await check("without its key nobody takes the line, and nothing on it can be read", async () => {
  if (readFileSync(join(state, "uplink.key"), "utf8").trim().length !== 32) throw new Error("the key");
  const wrong = join(folder("wrong"), "uplink.key");
  writeFileSync(wrong, "00000000000000000000000000000000\n");
  const thief = start(docent, ["gateway", "--from", `127.0.0.1:${door}`, "--key", wrong, "--port", "0"]);
  await thief.ended;
  if (thief.code === 0 || !/another key/.test(thief.output)) throw new Error(`${thief.code}: ${thief.output}`);
  const plain = new Line(door, "/uplink");
  await plain.opened.then(
    () => Promise.reject(new Error("a line without encryption was opened")),
    () => undefined,
  );
  if (["museum.json", '"pose"', '"type"', "Far away"].some((word) => line.seen.includes(word))) throw new Error("the line can be read");
});
await check("one holder of the key; the museum says where a second one is", async () => {
  const second = start(docent, ["gateway", "--from", `127.0.0.1:${door}`, "--key", join(state, "uplink.key"), "--port", "0"]);
  await second.ended;
  if (second.code === 0 || !/another gateway holds the line/.test(second.output)) throw new Error(`${second.code}: ${second.output}`);
  const health = await fetch(`http://127.0.0.1:${here}/api/health`).then((reply) => reply.json());
  const web = health.modules.find((one) => one.name === "web");
  if (!/second holder of the key/.test(web.reason)) throw new Error(JSON.stringify(web));
  const before = viewers[7].newest.pose.t;
  await until("the first one's line goes on", () => viewers[7].newest.pose.t > before);
});
await check("a line that breaks is opened again, and nobody has to do anything", async () => {
  line.cut();
  let last = 0;
  viewers[5].socket.on("message", (text) => JSON.parse(text).type === "pose" && (last = Date.now()));
  const cut = Date.now();
  await until("poses again", () => last > cut + 500, 15000);
  return `${((Date.now() - cut) / 1000).toFixed(1)} s`;
});
viewers.forEach((viewer) => viewer.close());
await finish();
