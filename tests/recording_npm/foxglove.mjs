// node foxglove.mjs DOCENT MUSEUM: opens a running robot as Foxglove and Lichtblick do, with npm's @foxglove/ws-protocol in the
// version of each, and decodes what it shows with the decoders of each.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import protocol from "@foxglove/ws-protocol";
import lichtblickRosmsg from "@lichtblick/rosmsg";
import lichtblickSerialization from "@lichtblick/rosmsg2-serialization";
import lichtblickProtocol from "lichtblick-ws-protocol";
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import assert from "node:assert/strict";
import WebSocket from "ws";

const { FoxgloveClient } = protocol;
const [OLDER, NEWER] = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
// What each viewer opens and reads with: Lichtblick's are the packages and the names of its FoxgloveWebSocketPlayer.
const FOXGLOVE = { Client: FoxgloveClient, names: [FoxgloveClient.SUPPORTED_SUBPROTOCOL], parse, MessageReader };
const LICHTBLICK = { Client: lichtblickProtocol.FoxgloveClient, names: [lichtblickProtocol.FoxgloveClient.SUPPORTED_SUBPROTOCOL, NEWER],
  parse: lichtblickRosmsg.parse, MessageReader: lichtblickSerialization.MessageReader };
const [docent, museum] = process.argv.slice(2);
const PATIENCE = 20000; // [ms]
let passed = 0;
let failed = 0;
async function check(name, body) {
  try {
    await body();
    passed += 1;
    console.log(`ok      ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}: ${String(error.message ?? error).slice(0, 600)}`);
  }
}
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
async function until(what, condition) {
  for (const end = Date.now() + PATIENCE; Date.now() < end; await pause(50)) {
    const value = await condition();
    if (value) return value;
  }
  throw new Error(`${what}: not within ${PATIENCE / 1000} s`);
}
const port = await new Promise((resolve) => {
  const server = createServer();
  server.listen(0, "127.0.0.1", () => {
    const { port: free } = server.address();
    server.close(() => resolve(free));
  });
});

const robot = spawn(docent, ["simulate", "--museum", museum, "--crowd", "busy", "--hours", "1", "--pace", "1", "--port", String(port), "--quiet",
  "--start=9,4,90"], { stdio: ["ignore", "ignore", "inherit"] });
let hasEnded = false;
robot.once("exit", () => (hasEnded = true));
const url = `ws://127.0.0.1:${port}/foxglove`;
await until("the page answers", () => {
  assert(!hasEnded, "the robot has ended");
  return fetch(`http://127.0.0.1:${port}/`).then((reply) => reply.ok, () => false);
});

/** A client with its channels and what it has got, by topic. */
function connect(viewer = FOXGLOVE) {
  const socket = new WebSocket(url, viewer.names);
  const client = new viewer.Client({ ws: socket });
  const seen = { socket, client, channels: new Map(), topics: new Map(), messages: {}, statuses: [], info: null, error: null };
  client.on("serverInfo", (info) => (seen.info = info));
  client.on("status", (status) => seen.statuses.push(status));
  client.on("error", (error) => (seen.error = error));
  client.on("advertise", (channels) => channels.forEach((channel) => seen.channels.set(channel.topic, channel)));
  client.on("message", ({ subscriptionId, timestamp, data }) => {
    const { topic, reader } = seen.topics.get(subscriptionId);
    (seen.messages[topic] ??= []).push({ time: timestamp, message: reader.readMessage(data) });
  });
  seen.subscribe = (topic) => {
    const channel = seen.channels.get(topic);
    const id = client.subscribe(channel.id);
    seen.topics.set(id, { topic, reader: new viewer.MessageReader(viewer.parse(channel.schema, { ros2: true })) });
    return id;
  };
  seen.newest = (topic, good = () => true) =>
    until(`a message on ${topic}`, () => seen.messages[topic]?.findLast(({ message }) => good(message))?.message);
  return seen;
}

const first = connect();
await check("names itself and lists its channels", async () => {
  await until("channels", () => first.channels.size > 0);
  assert.match(first.info.name, /^Docent, /);
  for (const topic of ["/scan_front", "/map", "/amcl_pose", "/odom", "/tf", "/docent/belief", "/camera/image/compressed", "/docent/people_markers"])
    assert(first.channels.has(topic), `no ${topic}`);
  for (const channel of first.channels.values()) {
    assert.equal(channel.encoding, "cdr");
    assert.equal(channel.schemaEncoding, "ros2msg");
    parse(channel.schema, { ros2: true });
  }
  assert(![...first.channels.keys()].some((topic) => topic.includes("truth")), "it tells the truth");
});
await check("nothing comes that nobody asked for", async () => {
  await pause(500);
  assert.deepEqual(first.messages, {});
});
await check("decodes a scan", async () => {
  first.subscribe("/scan_front");
  const scan = await first.newest("/scan_front");
  assert.equal(scan.ranges.length, 180);
  assert(scan.ranges.filter((range) => range > 0.05 && range < scan.range_max).length > 60);
});
await check("decodes the map, which was said before", async () => {
  first.subscribe("/map");
  const map = await first.newest("/map");
  assert.equal(map.data.length, map.info.width * map.info.height);
  assert(map.data.includes(100) && map.data.includes(0));
});
await check("decodes the belief and the pose", async () => {
  first.subscribe("/docent/belief");
  first.subscribe("/amcl_pose");
  first.subscribe("/odom");
  const odometry = await first.newest("/odom");
  assert(Math.hypot(odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w) > 0.99);
  await first.newest("/docent/belief", (belief) => belief.hypotheses.length > 0);
  const pose = await first.newest("/amcl_pose");
  assert(Math.abs(pose.pose.pose.position.x) < 100 && pose.header.frame_id === "map");
});
await check("decodes a camera's picture", async () => {
  first.subscribe("/camera/image/compressed");
  const picture = await first.newest("/camera/image/compressed");
  assert.equal(picture.format, "jpeg");
  assert.deepEqual([...picture.data.slice(0, 2)], [0xff, 0xd8]);
  assert.deepEqual([...picture.data.slice(-2)], [0xff, 0xd9]);
});
await check("times go on, and a topic ends when it is unsubscribed", async () => {
  const scans = first.messages["/scan_front"];
  assert(scans.length > 3 && scans.every(({ time }, i) => i === 0 || time >= scans[i - 1].time));
  const id = [...first.topics].find(([, { topic }]) => topic === "/scan_front")[0];
  first.client.unsubscribe(id);
  await pause(500);
  const before = scans.length;
  await pause(1000);
  assert.equal(scans.length, before);
});
await check("a second client gets the map, too", async () => {
  const second = connect();
  await until("channels", () => second.channels.size > 0);
  second.subscribe("/map");
  await second.newest("/map");
  second.client.close();
});
await check("Lichtblick's own packages read every topic", async () => {
  const viewer = connect(LICHTBLICK);
  await until("channels", () => viewer.channels.size > 0);
  assert.deepEqual([...viewer.channels.keys()].sort(), [...first.channels.keys()].sort());
  for (const topic of viewer.channels.keys()) viewer.subscribe(topic);
  const scan = await viewer.newest("/scan_front");
  assert.equal(scan.ranges.length, 180);
  const map = await viewer.newest("/map");
  assert.equal(map.data.length, map.info.width * map.info.height);
  for (const topic of ["/odom", "/tf", "/tf_static", "/amcl_pose", "/docent/belief", "/docent/health", "/camera/image/compressed", "/docent/museum_markers"])
    await viewer.newest(topic);
  assert.equal(viewer.error, null);
  assert.deepEqual(viewer.statuses, []);
  viewer.client.close();
});
await check("a line by the newer name alone says and shows the same", async () => {
  // Neither client opens by that name alone; its messages are those of the older one.
  const socket = new WebSocket(url, [NEWER]);
  const heard = { texts: [], messages: 0 };
  socket.on("message", (data, isBinary) => {
    if (isBinary) heard.messages += data[0] === 1 ? 1 : 0;
    else heard.texts.push(JSON.parse(data));
  });
  const channels = await until("channels", () => heard.texts.find(({ op }) => op === "advertise")?.channels);
  assert.equal(heard.texts[0].op, "serverInfo");
  const { id } = channels.find(({ topic }) => topic === "/odom");
  socket.send(JSON.stringify({ op: "subscribe", subscriptions: [{ id: 7, channelId: id }] }));
  await until("odometry", () => heard.messages > 3);
  socket.close();
});
await check("both names of the protocol are known, the client's first counts, and no other is", async () => {
  for (const [offered, wanted] of [[[OLDER], OLDER], [[NEWER], NEWER], [[OLDER, NEWER], OLDER], [["mqtt", NEWER, OLDER], NEWER], [["mqtt"], null]]) {
    const got = await new Promise((resolve) => {
      const socket = new WebSocket(url, offered);
      socket.once("open", () => { resolve(socket.protocol); socket.close(); });
      socket.once("error", (error) => resolve(/400/.test(error.message) ? null : error.message));
    });
    assert.equal(got, wanted, String(offered));
  }
});
await check("nothing can be published, and it says so", async () => {
  first.client.advertise({ topic: "/cmd_vel", encoding: "cdr", schemaName: "geometry_msgs/msg/Twist" });
  first.client.sendMessage(1, new Uint8Array([0, 1, 0, 0]));
  await until("two warnings", () => first.statuses.length >= 2);
  assert.match(first.statuses[0].message, /advertise is not served/);
});
await check("pages of other sites and those behind a proxy are refused", async () => {
  for (const headers of [{ Origin: "https://elsewhere.example" }, { "X-Forwarded-For": "192.0.2.7" }]) {
    const refused = await new Promise((resolve) => {
      const socket = new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL], { headers });
      socket.once("open", () => resolve(false));
      socket.once("error", (error) => resolve(/403/.test(error.message)));
    });
    assert(refused, JSON.stringify(headers));
  }
});
await check("a fifth client at once is turned away, and one more when another has gone", async () => {
  const more = [connect(), connect(), connect()];
  for (const one of more) await until("channels", () => one.channels.size > 0);
  const fifth = connect();
  await until("it is closed", () => fifth.error);
  more.forEach((one) => one.client.close());
  await pause(300);
  const again = connect();
  await until("channels", () => again.channels.size > 0);
  again.client.close();
});
await check("nonsense is answered and does no harm", async () => {
  const before = first.statuses.length;
  for (const text of ["", "{", '{"op":"subscribe","subscriptions":[{"id":1}]}', '{"op":"subscribe","subscriptions":[{"id":99,"channelId":4000}]}'])
    first.socket.send(text);
  await until("four answers", () => first.statuses.length >= before + 4);
  assert.equal(hasEnded, false);
});

first.client.close();
robot.kill("SIGTERM");
await until("the robot ends", () => hasEnded);
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
