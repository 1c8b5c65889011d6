// Prints a line for each message of an MCAP file as Foxglove's readers have it: topic, type, time, and the SHA-256 of
// its values: read_mcap.mjs FILE [--chunks | --images]. With --chunks the file may end anywhere: all that stands in
// whole records. With --images those of images alone: topic, width, height, encoding, bytes, time, stamp, and the
// SHA-256 of their bytes.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(process.env.SWELL_NODE_MODULES + "/");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { decompress } = require("fzstd");
const { McapIndexedReader, McapStreamReader } = await import(require.resolve("@mcap/core"));

const [path, mode] = process.argv.slice(2);

// Numbers as doubles, texts in UTF-8, bytes as they are.
function addValues(hash, value) {
  if (value instanceof Uint8Array) hash.update(value);
  else if (typeof value === "number" || typeof value === "boolean") {
    const bytes = Buffer.alloc(8);
    bytes.writeDoubleLE(Number(value));
    hash.update(bytes);
  } else if (typeof value === "string") hash.update(value);
  else if (Array.isArray(value) || ArrayBuffer.isView(value)) for (const one of value) addValues(hash, one);
  else for (const one of Object.values(value)) addValues(hash, one);
}

const readers = new Map();
const types = new Map();
const channels = new Map();

function add(record) {
  const text = new TextDecoder();
  if (record.type === "Schema") {
    types.set(record.id, record.name);
    readers.set(record.id, new MessageReader(parse(text.decode(record.data), { ros2: true })));
  } else if (record.type === "Channel") channels.set(record.id, record);
  else if (record.type === "Message") {
    const channel = channels.get(record.channelId);
    const type = types.get(channel.schemaId);
    if (mode === "--images" && type !== "sensor_msgs/msg/Image") return;
    const values = readers.get(channel.schemaId).readMessage(record.data);
    const hash = createHash("sha256");
    addValues(hash, mode === "--images" ? values.data : values);
    const said = [type, String(record.logTime)];
    if (mode === "--images") {
      const { sec, nanosec } = values.header.stamp;
      said.splice(0, 1, values.width, values.height, values.encoding, values.data.length);
      said.push(String(BigInt(sec) * 1000000000n + BigInt(nanosec)));
    }
    console.log(channel.topic, ...said, hash.digest("hex"));
  }
}

const file = readFileSync(path);
const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };
if (mode === "--chunks") {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(file);
  for (let record; (record = reader.nextRecord()); ) add(record);
} else {
  const readable = {
    size: async () => BigInt(file.length),
    read: async (offset, size) => new Uint8Array(file.buffer, file.byteOffset + Number(offset), Number(size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  for (const schema of reader.schemasById.values()) add(schema);
  for (const channel of reader.channelsById.values()) add(channel);
  for await (const message of reader.readMessages({ validateCrcs: true })) add(message);
}
