"""Reads MCAP files with CDR messages, from their public descriptions alone: every record, its CRCs and its index.

Source: mcap.dev, MCAP format specification; DDSI-RTPS 2.3, clause 10; the message definitions in the file itself.
"""
import ctypes
import ctypes.util
import hashlib
import struct
import sys
import typing
import zlib

MAGIC = b"\x89MCAP0\r\n"
(HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX, _, _, STATISTICS, _, _, SUMMARY_OFFSET,
 DATA_END) = range(1, 16)
NUMBERS = {"bool": "?", "int8": "b", "uint8": "B", "byte": "B", "char": "B", "int16": "h", "uint16": "H", "int32": "i",
           "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


class Message(typing.NamedTuple):
    topic: str
    type: str
    t_ns: int
    values: dict


class Recording(typing.NamedTuple):
    messages: list
    chunks: int
    is_whole: bool  # else it ends within a record


def decompressed(data, size):
    zstd = ctypes.CDLL(ctypes.util.find_library("zstd"))
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    zstd.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    buffer = ctypes.create_string_buffer(size)
    assert zstd.ZSTD_decompress(buffer, size, data, len(data)) == size
    return buffer.raw


class Bytes:
    """Takes values off the front."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, kind):
        value, = struct.unpack_from("<" + kind, self.data, self.at)
        self.at += struct.calcsize("<" + kind)
        return value

    def take(self, count):
        assert self.at + count <= len(self.data)
        self.at += count
        return self.data[self.at - count:self.at]

    def text(self):
        return self.take(self.number("I")).decode()

    def map(self, key, value):
        inner, result = Bytes(self.take(self.number("I"))), {}
        while inner.at < len(inner.data):
            name = key(inner)
            result[name] = value(inner)
        return result


def records(data, at=0):
    """(opcode, content, place) of each whole record, then None where the data ends within one."""
    while at < len(data):
        if at + 9 > len(data):
            yield None
            return
        opcode, size = struct.unpack_from("<BQ", data, at)
        if at + 9 + size > len(data):
            yield None
            return
        yield opcode, data[at + 9:at + 9 + size], at
        at += 9 + size


# ---- Messages

def definitions(text, name):
    """{type: [(type, is array, length, field)]} of a schema's text."""
    parts = text.split("=" * 80 + "\nMSG: ")
    found = {name.replace("/msg/", "/"): parts[0]}
    found |= dict(part.split("\n", 1) for part in parts[1:])

    def fields(lines):
        for line in lines.splitlines():
            kind, field = line.split()[:2]
            if "=" in field:
                continue
            base, _, length = kind.partition("[")
            yield base, bool(length), length.rstrip("]"), field
    return {kind: list(fields(lines)) for kind, lines in found.items()}


class Cdr:
    """Little endian, numbers aligned to their size behind the four bytes that say so."""

    def __init__(self, data, kinds):
        assert data[:4] == b"\0\1\0\0"
        self.data, self.at, self.kinds = data[4:], 0, kinds

    def number(self, kind):
        size = struct.calcsize(kind)
        self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + kind, self.data, self.at - size)[0]

    def value(self, kind):
        if kind in NUMBERS:
            return self.number(NUMBERS[kind])
        if kind == "string":
            size = self.number("I")
            self.at += size
            assert self.data[self.at - 1] == 0
            return self.data[self.at - size:self.at - 1].decode()
        return {field: self.array(base, length) if is_array else self.value(base)
                for base, is_array, length, field in self.kinds[kind]}

    def array(self, kind, length):
        count = int(length) if length else self.number("I")
        if kind == "uint8":
            self.at += count
            return self.data[self.at - count:self.at]
        return [self.value(kind) for _ in range(count)]


# ---- Files

class Reader:
    def __init__(self, data):
        assert data.startswith(MAGIC)
        self.data, self.schemas, self.channels = data, {}, {}
        self.messages, self.sequences = [], {}
        self.chunk_indexes, self.last_chunk = [], None

    def definition(self, opcode, content):
        b = Bytes(content)
        if opcode == SCHEMA:
            number, name, encoding, text = b.number("H"), b.text(), b.text(), b.text()
            assert encoding == "ros2msg" and number > 0
            self.schemas[number] = (name, definitions(text, name))
        elif opcode == CHANNEL:
            number, schema, topic, encoding = b.number("H"), b.number("H"), b.text(), b.text()
            assert encoding == "cdr"
            self.channels[number] = (topic, *self.schemas[schema])

    def message(self, content):
        b = Bytes(content)
        channel, sequence, logged, published = (b.number(kind) for kind in "HIQQ")
        assert logged == published and sequence == self.sequences.get(channel, 0)
        self.sequences[channel] = sequence + 1
        topic, name, kinds = self.channels[channel]
        cdr = Cdr(content[b.at:], kinds)
        values = cdr.value(name.replace("/msg/", "/"))
        assert cdr.at == len(cdr.data), f"{topic}: {len(cdr.data) - cdr.at} bytes too many"
        self.messages.append(Message(topic, name, logged, values))
        return channel, logged

    def chunk(self, content, place):
        b = Bytes(content)
        begin, end, size, crc, compression = b.number("Q"), b.number("Q"), b.number("Q"), b.number("I"), b.text()
        assert compression == "zstd"
        data = decompressed(b.take(b.number("Q")), size)
        assert zlib.crc32(data) == crc and b.at == len(content)
        index, times = {}, []
        for opcode, message, at in records(data):
            assert opcode == MESSAGE
            channel, logged = self.message(message)
            index.setdefault(channel, []).append((logged, at))
            times.append(logged)
        assert (begin, end) == (min(times), max(times))
        self.last_chunk = {"begin": begin, "end": end, "place": place, "size": 9 + len(content), "index": index,
                           "places": {}, "index_size": 0}
        self.chunk_indexes.append(self.last_chunk)

    def message_index(self, content, place):
        b = Bytes(content)
        channel, count = b.number("H"), b.number("I") // 16
        assert [(b.number("Q"), b.number("Q")) for _ in range(count)] == self.last_chunk["index"][channel]
        self.last_chunk["places"][channel] = place
        self.last_chunk["index_size"] += 9 + len(content)

    def check_summary(self, data_end):
        """The rest of the file behind the data."""
        assert self.data.endswith(MAGIC)
        footer = self.data[-8 - 20:-8]
        begin, offsets, crc = struct.unpack("<QQI", footer)
        assert begin == data_end and zlib.crc32(self.data[begin:-12]) == crc
        groups, indexes = [], 0
        for opcode, content, place in records(self.data[:-8], begin):
            b = Bytes(content)
            if opcode in (SCHEMA, CHANNEL):
                self.definition(opcode, content)
            elif opcode == STATISTICS:
                counts = tuple(b.number(kind) for kind in "QHIIII")
                assert counts == (len(self.messages), len(self.schemas), len(self.channels), 0, 0,
                                  len(self.chunk_indexes)), counts
                times = [message.t_ns for message in self.messages]
                assert (b.number("Q"), b.number("Q")) == (min(times), max(times))
                per_channel = b.map(lambda b: b.number("H"), lambda b: b.number("Q"))
                assert {c: n for c, n in per_channel.items() if n} == self.sequences
            elif opcode == CHUNK_INDEX:
                chunk = self.chunk_indexes[indexes]
                indexes += 1
                assert [b.number("Q") for _ in range(4)] == [chunk[k] for k in ("begin", "end", "place", "size")]
                assert b.map(lambda b: b.number("H"), lambda b: b.number("Q")) == chunk["places"]
                assert b.number("Q") == chunk["index_size"]
            elif opcode == SUMMARY_OFFSET:
                groups.append((b.number("B"), b.number("Q"), b.number("Q")))
                assert place >= offsets
        assert indexes == len(self.chunk_indexes)
        for opcode, start, size in groups:
            assert {record[0] for record in records(self.data[:start + size], start)} == {opcode}

    def read(self):
        for record in records(self.data, len(MAGIC)):
            if record is None:
                return Recording(self.messages, len(self.chunk_indexes), False)
            opcode, content, place = record
            if opcode == HEADER:
                assert Bytes(content).text() == "ros2"
            elif opcode in (SCHEMA, CHANNEL):
                self.definition(opcode, content)
            elif opcode == CHUNK:
                self.chunk(content, place)
            elif opcode == MESSAGE_INDEX:
                self.message_index(content, place)
            else:
                assert opcode == DATA_END and struct.unpack("<I", content)[0] == zlib.crc32(self.data[:place])
                self.check_summary(place + 9 + len(content))
                return Recording(self.messages, len(self.chunk_indexes), True)
        return Recording(self.messages, len(self.chunk_indexes), False)


def read(path):
    with open(path, "rb") as file:
        return Reader(file.read()).read()


# ---- Lines

def add_values(digest, value):
    """Numbers as doubles, texts in UTF-8, bytes as they are."""
    if isinstance(value, (bytes, str)):
        digest.update(value if isinstance(value, bytes) else value.encode())
    elif isinstance(value, (dict, list)):
        for one in value.values() if isinstance(value, dict) else value:
            add_values(digest, one)
    else:
        digest.update(struct.pack("<d", float(value)))


def line(message):
    """As read_mcap.mjs prints it."""
    digest = hashlib.sha256()
    add_values(digest, message.values)
    return f"{message.topic} {message.type} {message.t_ns} {digest.hexdigest()}"


if __name__ == "__main__":
    for read_message in read(sys.argv[1]).messages:
        print(line(read_message))
