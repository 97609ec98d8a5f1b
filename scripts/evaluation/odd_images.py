"""Encoders of pictures for odd_maps: PGM and PNG in every form that their formats allow, written from the formats' documents."""
import struct
import zlib

ADAM7 = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]  # first column, row; steps
CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
DEPTHS = {0: [1, 2, 4, 8, 16], 2: [8, 16], 3: [1, 2, 4, 8], 4: [8, 16], 6: [8, 16]}


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def packed_row(samples, depth):
    """Bytes of a row's samples."""
    if depth == 16:
        return struct.pack(f">{len(samples)}H", *samples)
    if depth == 8:
        return bytes(samples)
    row, bits, held = bytearray(), 0, 0
    for sample in samples:
        bits, held = bits << depth | sample, held + depth
        if held == 8:
            row.append(bits)
            bits, held = 0, 0
    if held:
        row.append(bits << (8 - held))
    return bytes(row)


def filtered(row, above, kind, width):
    """A row by one of the five filters; `width`: bytes of a pixel, at least one."""
    out = bytearray([kind])
    for i, value in enumerate(row):
        left = row[i - width] if i >= width else 0
        up = above[i] if above else 0
        corner = above[i - width] if above and i >= width else 0
        estimate = left + up - corner
        near = min((abs(estimate - v), k, v) for k, v in enumerate((left, up, corner)))[2]
        out.append(value - (0, left, up, (left + up) // 2, near)[kind] & 255)
    return bytes(out)


def png(rows, depth, colour, rng, ancillary=(), interlaced=False):
    """rows: of pixels, each a tuple of samples. ancillary: (name, data), before the pixels. Filters and cuts at random."""
    height, columns = len(rows), len(rows[0])
    width = max(1, CHANNELS[colour] * depth // 8)
    raw = b""
    for column, row, across, down in ADAM7 if interlaced else [(0, 0, 1, 1)]:
        above = None
        for pixels in rows[row::down]:
            samples = [sample for pixel in pixels[column::across] for sample in pixel]
            if not samples:
                continue
            line = packed_row(samples, depth)
            raw += filtered(line, above, rng.randrange(5), width)
            above = line
    data = zlib.compress(raw, rng.choice([0, 1, 9]))
    cuts = sorted(rng.randrange(len(data) + 1) for _ in range(rng.choice([0, 0, 1, 4])))
    pieces = [data[a:b] for a, b in zip([0, *cuts], [*cuts, len(data)])]
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", columns, height, depth, colour, 0, 0, int(interlaced)))
    return (b"\x89PNG\r\n\x1a\n" + head + b"".join(chunk(n, d) for n, d in ancillary) + b"".join(chunk(b"IDAT", p) for p in pieces) +
            (chunk(b"tIME", bytes([7, 230, 11, 30, 9, 0, 0])) if rng.random() < 0.3 else b"") + chunk(b"IEND", b""))


def shown(rng):
    """Chunks that say how a screen shows it, which is nothing about what it means; in the order that the format asks for."""
    profile = b"odd\0\0" + zlib.compress(bytes(rng.randrange(256) for _ in range(rng.choice([20, 400]))))
    colour = rng.choice([[(b"sRGB", bytes([rng.randrange(4)]))], [(b"iCCP", profile)], [], []])
    return [*([(b"gAMA", struct.pack(">I", rng.choice([22727, 45455, 55556, 100000, 220000])))] if rng.random() < 0.8 else []),
            *([(b"cHRM", struct.pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000))] if rng.random() < 0.3 else []), *colour]


def pgm(rows, white, rng, text=False, head=None, tail=b""):
    """head: bytes before the pixels, else one at random."""
    if head is None:
        head = pgm_head(len(rows[0]), len(rows), white, rng, text)
    if text:
        gap = lambda: rng.choice([" ", "  ", "\n", "\t", "\r\n", "\n# odd\n"])  # noqa: E731
        return head + "".join(f"{v}{gap()}" for row in rows for v in row).encode() + tail
    return head + b"".join(packed_row(row, 16 if white > 255 else 8) for row in rows) + tail


def pgm_head(columns, height, white, rng, text=False):
    end = rng.choice(["\n", "\n", "\r\n", " ", "\t"])
    said = lambda: rng.choice(["", "", "# CREATOR: odd 5 6 7" + (end if "\n" in end else "\n"), "#\n"])  # noqa: E731
    last = "\n" if text else "\r\n" if end == "\r\n" else rng.choice(["\n", " ", "\t"])
    return f"{'P2' if text else 'P5'}{end}{said()}{columns}{rng.choice([' ', end])}{said()}{height}{end}{said()}{white}{last}".encode()


OTHERS = {
    "BMP": b"BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0" + bytes(40),
    "JPEG": b"\xff\xd8\xff\xe0\0\x10JFIF\0\1\1\0\0\1\0\1\0\0" + bytes(40),
    "TIFF": b"II*\0\x08\0\0\0" + bytes(40),
    "TIFF ": b"MM\0*\0\0\0\x08" + bytes(40),
    "GIF": b"GIF89a\2\0\2\0\x80\0\0" + bytes(20),
    "WebP": b"RIFF\x24\0\0\0WEBPVP8 " + bytes(20),
    "PPM": b"P6\n2 2\n255\n" + bytes(12),
    "bitmap": b"P4\n8 2\n\1\2",
    "gzip": b"\x1f\x8b\x08\0" + bytes(30),
    "SVG": b'<svg xmlns="http://www.w3.org/2000/svg"></svg>',
}
