// Reads a recording with other people's libraries: what it says does not rest on our own reader.
import { readFileSync } from 'node:fs';
import { McapStreamReader } from '@mcap/core';
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import { decompress } from 'fzstd';

/** Calls take(topic, message, seconds) for every message of the topics named, in the order of the file. */
export function readRecording(path, topics, take) {
  const reader = new McapStreamReader({
    decompressHandlers: { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) },
  });
  reader.append(readFileSync(path));
  const schemas = new Map();
  const channels = new Map();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === 'Schema') {
      schemas.set(record.id, record);
    } else if (record.type === 'Channel') {
      const topic = record.topic.replace(/^\//, '');
      if (!topics.includes(topic)) continue;
      const schema = schemas.get(record.schemaId);
      const text = new TextDecoder().decode(schema.data);
      channels.set(record.id, { topic, reader: new MessageReader(parse(text, { ros2: true })) });
    } else if (record.type === 'Message') {
      const channel = channels.get(record.channelId);
      if (channel) take(channel.topic, channel.reader.readMessage(record.data), Number(record.logTime) / 1e9);
    }
  }
}
