// What the tests of several gateways share: PostgreSQL and nginx of their own, gateways that can be killed, viewers.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import WebSocket from "ws";

export const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
export const docent = process.env.DOCENT_BINARY ?? join(root, "build", "dev", "bin", "docent");
export const museum = join(root, "museums", "bonn");

const clean = [];
let passed = 0;
let failed = 0;
export async function check(name, body) {
  try {
    const said = await body();
    passed += 1;
    console.log(`ok      ${name}${said ? `: ${said}` : ""}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}: ${String(error.message ?? error).slice(0, 600)}`);
  }
}
export async function finish() {
  for (const action of clean.reverse()) await Promise.resolve(action()).catch(() => undefined);
  console.log(`${passed} passed, ${failed} failed`);
  process.exit(failed > 0 || passed === 0 ? 1 : 0);
}
export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
export async function until(what, condition, patience = 20000, step = 50) {
  for (const end = Date.now() + patience; Date.now() < end; await pause(step)) {
    const value = await condition();
    if (value) return value;
  }
  throw new Error(`${what}: not within ${patience / 1000} s`);
}
export async function freePort() {
  return new Promise((resolve) => {
    const server = createServer();
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}
export function folder(name) {
  const path = mkdtempSync(join(tmpdir(), `docent-${name}-`));
  clean.push(() => rmSync(path, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 }));
  return path;
}

/** What still runs; a test that breaks off leaves nothing behind either. */
const children = new Set();
process.on("exit", () => children.forEach((child) => child.kill()));

/** A process that ends with the tests. */
export function start(command, words) {
  const child = spawn(command, words, { stdio: ["ignore", "pipe", "pipe"] });
  const it = { child, output: "", code: null, ended: null };
  const keep = (text) => (it.output = (it.output + text).slice(-4000));
  children.add(child);
  child.once("exit", () => children.delete(child));
  child.stdout.on("data", keep);
  child.stderr.on("data", keep);
  it.ended = new Promise((resolve) => child.once("exit", (code) => resolve((it.code = code ?? -1))));
  it.end = async (signal = "SIGTERM") => {
    if (it.code !== null) return;
    child.kill(signal);
    const timer = setTimeout(() => child.kill("SIGKILL"), 10000);
    await it.ended;
    clearTimeout(timer);
  };
  clean.push(() => it.end());
  return it;
}

/** A PostgreSQL of its own, on a socket in a temporary folder: its address, and what a query answers. */
export function postgres() {
  const versions = readdirSync("/usr/lib/postgresql");
  const programs = join("/usr/lib/postgresql", versions[versions.length - 1], "bin");
  const place = folder("postgres");
  const isRoot = process.getuid() === 0;
  const run = (...words) => {
    const all = isRoot ? ["setpriv", "--reuid", "postgres", "--regid", "postgres", "--clear-groups", ...words] : words;
    const done = spawnSync(all[0], all.slice(1), { stdio: ["ignore", "ignore", "pipe"], encoding: "utf8" });
    if (done.status !== 0) throw new Error(done.stderr);
  };
  if (isRoot) spawnSync("chown", ["postgres", place]);
  const data = join(place, "data");
  run(join(programs, "initdb"), "-D", data, "-A", "trust", "-U", "docent", "--no-sync");
  run(join(programs, "pg_ctl"), "-w", "-D", data, "-l", join(place, "log"), "-o", `-c listen_addresses='' -c unix_socket_directories=${place}`, "start");
  clean.push(() => run(join(programs, "pg_ctl"), "-m", "immediate", "-D", data, "stop"));
  return {
    address: `postgresql:///postgres?user=docent&host=${place}`,
    /** All its processes stand, or go on: nobody is told, and nothing is closed. */
    hang(stands) {
      const server = Number(readFileSync(join(data, "postmaster.pid"), "utf8").split("\n")[0]);
      const others = spawnSync("ps", ["-o", "pid=", "--ppid", String(server)], { encoding: "utf8" }).stdout.split("\n").filter(Boolean).map(Number);
      for (const pid of [server, ...others]) process.kill(pid, stands ? "SIGSTOP" : "SIGCONT");
    },
    rows(statement) {
      const done = spawnSync(join(programs, "psql"), ["-h", place, "-U", "docent", "-d", "postgres", "-tAc", statement], { encoding: "utf8" });
      if (done.status !== 0) throw new Error(done.stderr);
      return done.stdout.split("\n").filter(Boolean);
    },
  };
}

/** nginx before these gateways, by the configuration that is shipped. */
export async function nginx(ports) {
  const place = folder("nginx");
  const port = await freePort();
  let shipped = readFileSync(join(root, "share", "nginx", "docent.conf"), "utf8");
  [8080, 8081].forEach((old, i) => (shipped = shipped.replace(`127.0.0.1:${old}`, `127.0.0.1:${ports[i]}`)));
  shipped = shipped.replace("listen 80;", `listen 127.0.0.1:${port};`);
  const temporary = ["client_body", "proxy", "fastcgi", "uwsgi", "scgi"].map((kind) => `${kind}_temp_path ${join(place, kind)};`).join("\n");
  writeFileSync(
    join(place, "nginx.conf"),
    `daemon off; pid ${join(place, "pid")}; error_log ${join(place, "error.log")}; worker_processes 1;
     events { worker_connections 4000; } http { access_log off; ${temporary}\n${shipped}\n}`,
  );
  const server = start("/usr/sbin/nginx", ["-c", join(place, "nginx.conf"), "-p", place]);
  await until("nginx listens", async () => {
    if (server.code !== null) throw new Error(`nginx: ${server.output}`);
    return fetch(`http://127.0.0.1:${port}/metrics`).then(() => true, () => false);
  });
  return port;
}

/** A gateway: the module `web` as a process of its own. */
export async function gateway(port, domain, database, state, settings = []) {
  const words = ["run", "web", "--museum", museum, "--domain", String(domain), "--state", state, "--set", `web.port=${port}`];
  for (const setting of [database && `web.database=${database}`, ...settings].filter(Boolean)) words.push("--set", setting);
  const it = start(docent, words);
  await until(`the gateway at ${port}`, async () => {
    if (it.code !== null) throw new Error(`docent run web ended: ${it.output}`);
    return fetch(`http://127.0.0.1:${port}/metrics`).then((reply) => reply.ok, () => false);
  }, 20000, 20);
  return it;
}

/** A line to a gateway: its newest messages by type, and answers. */
export class Line {
  newest = {};
  answers = new Map();
  constructor(port, path = "/live", headers = {}) {
    this.socket = new WebSocket(`ws://127.0.0.1:${port}${path}`, { headers });
    this.opened = new Promise((resolve, reject) => {
      this.socket.once("open", resolve);
      this.socket.once("error", reject);
    });
    this.opened.catch(() => undefined);
    this.socket.on("error", () => undefined);
    this.socket.on("message", (text) => {
      const message = JSON.parse(text);
      this.newest[message.type] = message;
      if (message.type === "ack" || message.type === "refused") this.answers.set(message.id, message);
    });
  }
  say(message) {
    this.socket.send(JSON.stringify(message));
  }
  async ask(message) {
    this.say(message);
    const answer = await until(`an answer to ${message.type}`, () => this.answers.get(message.id), 8000, 5);
    if (answer.type !== "ack") throw new Error(`${message.type} was refused: ${JSON.stringify(answer.reason)}`);
  }
  close() {
    this.socket.terminate();
  }
}

export function uuid7() {
  const random = [...crypto.getRandomValues(new Uint8Array(10))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  const time = Date.now().toString(16).padStart(12, "0");
  return `${time.slice(0, 8)}-${time.slice(8)}-7${random.slice(0, 3)}-8${random.slice(3, 6)}-${random.slice(6, 18)}`;
}

/** Calls to /api/v1 with the login that it holds. */
export class Caller {
  cookie = "";
  csrf = "";
  constructor(port) {
    this.port = port;
  }
  async call(method, path, body) {
    const reply = await fetch(`http://127.0.0.1:${this.port}/api/v1${path}`, {
      method,
      headers: { ...(body && { "Content-Type": "application/json" }), Cookie: this.cookie, "Docent-Csrf": this.csrf },
      body: body && JSON.stringify(body),
    });
    const document = await reply.json();
    if (!reply.ok) throw new Error(`${method} ${path}: ${reply.status} ${JSON.stringify(document)}`);
    const cookie = reply.headers.get("set-cookie");
    if (cookie) this.cookie = cookie.split(";")[0];
    if (document.csrf !== undefined) this.csrf = document.csrf;
    return document;
  }
  /** The same person at another gateway. */
  at(port) {
    return Object.assign(new Caller(port), { cookie: this.cookie, csrf: this.csrf });
  }
}
