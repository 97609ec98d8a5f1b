// node check.mjs FILE.mcap [EXPECTED.json]: opens a recording with @mcap/core, checks every checksum, decodes every message
// from its embedded schema; with EXPECTED.json compares every field, and checks that a damaged copy is found out.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import * as zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import assert from "node:assert/strict";
import { open, readFile } from "node:fs/promises";

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

await zstd.isLoaded;
const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };
const [file, expectedFile] = process.argv.slice(2);
const bytes = new Uint8Array(await readFile(file));

/// As the expectation is written: 64-bit integers as texts, lists as plain arrays, ROS 2's name for nanoseconds.
function plain(value) {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (Array.isArray(value)) return value.map(plain);
  if (value !== null && typeof value === "object") {
    const isTime = Object.keys(value).length === 2 && "sec" in value && "nsec" in value;
    if (isTime) return { sec: value.sec, nanosec: value.nsec };
    return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, plain(inner)]));
  }
  return value;
}

const readers = new Map();
function decode(schema, message) {
  if (!readers.has(schema.id)) {
    const text = new TextDecoder().decode(schema.data);
    readers.set(schema.id, new MessageReader(parse(text, { ros2: true })));
  }
  return readers.get(schema.id).readMessage(message.data);
}

function streamed(content) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const counts = {};
  reader.append(content);
  for (let record; (record = reader.nextRecord()); ) counts[record.type] = (counts[record.type] ?? 0) + 1;
  return { counts, done: reader.done() };
}

/// What the compressed bytes of a chunk hold; null where they cannot be decompressed.
function unpacked(compressed, chunk) {
  try {
    return Buffer.from(zstd.decompress(compressed, Number(chunk.uncompressedSize)));
  } catch {
    return null;
  }
}

const read = [];
await check("the index leads to every message; all checksums hold", async () => {
  const handle = await open(file, "r");
  const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(handle), decompressHandlers });
  assert.equal(reader.header.profile, "ros2");
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    assert.ok(message.logTime >= last, "messages come in the order of their times");
    last = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, "ros2msg");
    assert.equal(channel.messageEncoding, "cdr");
    assert.ok(channel.metadata.get("offered_qos_profiles").includes("durability:"));
    read.push({ topic: channel.topic, type: schema.name, log_time: message.logTime.toString(), message: plain(decode(schema, message)) });
  }
  const counted = reader.statistics;
  assert.equal(Number(counted.messageCount), read.length);
  assert.equal(counted.channelCount, reader.channelsById.size);
  assert.equal(counted.chunkCount, reader.chunkIndexes.length);
  let sum = 0n;
  for (const count of counted.channelMessageCounts.values()) sum += count;
  assert.equal(Number(sum), read.length);
  assert.equal(counted.messageEndTime, last);
  await handle.close();
});

await check("the same as a stream, from first byte to last", () => {
  const { counts, done } = streamed(bytes);
  assert.ok(done);
  assert.equal(counts.Message, read.length);
  assert.equal(counts.DataEnd, 1);
  assert.equal(counts.Footer, 1);
});

if (expectedFile !== undefined) {
  const expected = JSON.parse(await readFile(expectedFile, "utf8"));
  await check(`every field of ${expected.length} messages of ${new Set(expected.map((e) => e.topic)).size} topics`, () => {
    assert.equal(read.length, expected.length);
    for (let i = 0; i < expected.length; ++i) assert.deepEqual(read[i], expected[i], `message ${i} on ${expected[i].topic}`);
  });
  await check("a flipped bit in any chunk is found out", async () => {
    const handle = await open(file, "r");
    const reader = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(handle), decompressHandlers });
    await handle.close();
    assert.ok(reader.chunkIndexes.length > 0);
    for (const chunk of reader.chunkIndexes) {
      // Between the chunks lie the message indexes, which have no checksum: the flip has to be inside a chunk's records.
      const begin = Number(chunk.chunkStartOffset + chunk.chunkLength - chunk.compressedSize);
      const end = begin + Number(chunk.compressedSize);
      const content = unpacked(bytes.subarray(begin, end), chunk);
      assert.ok(content !== null);
      // A bit may say nothing: a match that zstd takes from elsewhere can have the same bytes. The first from the middle on
      // that changes the chunk's content, or makes it unreadable, is the one to be found out.
      let inside = begin + Math.floor((end - begin) / 2);
      let damaged;
      do {
        assert.ok(inside < end, `no bit matters in the chunk at ${chunk.chunkStartOffset}`);
        damaged = bytes.slice();
        damaged[inside++] ^= 4;
      } while (unpacked(damaged.subarray(begin, end), chunk)?.equals(content));
      assert.throws(() => streamed(damaged), `chunk at ${chunk.chunkStartOffset}`);
    }
  });
  await check("a flipped bit in the summary is found out", async () => {
    const damaged = bytes.slice();
    damaged[damaged.length - 60] ^= 4;
    const readable = (content) => ({
      size: async () => BigInt(content.length),
      read: async (offset, size) => content.subarray(Number(offset), Number(offset + size)),
    });
    await McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });
    await assert.rejects(McapIndexedReader.Initialize({ readable: readable(damaged), decompressHandlers }), /crc/i);
  });
  await check("a recording cut short gives what it still holds", () => {
    const { counts, done } = streamed(bytes.slice(0, Math.floor(bytes.length * 0.6)));
    assert.ok(!done);
    assert.ok(counts.Message > 0.4 * read.length, `${counts.Message} of ${read.length}`);
  });
}

console.log(`${passed} passed, ${failed} failed`);
process.exit(failed === 0 && passed > 0 ? 0 : 1);
