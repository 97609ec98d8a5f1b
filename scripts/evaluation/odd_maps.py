"""Maps of others, by what the formats of map_server, PGM, PNG and YAML allow. Each case knows from how it was made what its cells are.

A case: `what` "map", `path`, `image`; `cells` [rows from the top, columns] -1, 0..100, with `resolution`, `x`, `y`; or None: there is no right value.
`refusal`: what a refusal must say, where one is right; `say`: what the notes must say; `near`: of cells, where a mode rounds.
"""
import math
import struct

import numpy as np

from .odd_images import CHANNELS, DEPTHS, OTHERS, chunk, pgm, png, shown

UNKNOWN, FREE, WALL = -1, 0, 100
MARGIN = 0.004  # of shares: nearer to a threshold no shade is chosen, for map_servers round differently
SAVERS_UNKNOWN = 205 / 255  # of white, in trinary mode


class Meaning:
    """What a YAML file says of shades."""

    def __init__(self, rng, mode="trinary", negate=False, usual=False):
        self.mode, self.negate, self.occupied, self.free = mode, negate, 0.65, 0.196
        if not usual:
            self.occupied, self.free = rng.choice([(0.65, 0.196), (0.65, 0.25), (0.9, 0.1), (0.5, 0.2), (0.65, 0.05), (0.75, 0.4)])

    def cell(self, share):
        """None: too near to say."""
        occupied = share if self.negate else 1 - share
        if self.mode == "raw":
            percent = round(share * 255, 6)
            return None if abs(percent % 1 - 0.5) < 0.02 else int(round(percent)) if percent < 100.5 else UNKNOWN
        if min(abs(occupied - self.occupied), abs(occupied - self.free)) < MARGIN and abs(share - 205 / 255) > 1e-9:
            return None
        if self.mode == "trinary" and not self.negate and abs(share - SAVERS_UNKNOWN) < 1.5 * MARGIN:
            return UNKNOWN if abs(share - SAVERS_UNKNOWN) < 1e-9 else None
        if occupied > self.occupied:
            return WALL
        if occupied < self.free:
            return FREE
        return UNKNOWN if self.mode == "trinary" else int(round(100 * (occupied - self.free) / (self.occupied - self.free)))


def plan(rng, columns=None, rows=None):
    """[rows from the top, columns] of UNKNOWN, FREE, WALL: a room or two amid what is unknown, and specks."""
    columns, rows = columns or rng.randrange(4, 40), rows or rng.randrange(4, 30)
    cells = np.full((rows, columns), UNKNOWN)
    for _ in range(rng.choice([1, 2])):
        a, b = sorted(rng.sample(range(columns), 2))
        c, d = sorted(rng.sample(range(rows), 2))
        cells[c:d + 1, a:b + 1] = WALL
        cells[c + 1:d, a + 1:b] = FREE
    for _ in range(rng.randrange(12)):
        cells[rng.randrange(rows), rng.randrange(columns)] = rng.choice([UNKNOWN, FREE, WALL])
    return cells


def drawn(cells, pixels, rng):
    """(rows of pixels, their cells): of each class some of `pixels`, which are (pixel, cell); classes without one become another."""
    classes = {}
    for pixel, cell in pixels:
        kind = UNKNOWN if cell == UNKNOWN else WALL if cell >= 65 else FREE
        classes.setdefault(kind, []).append((pixel, cell))
    chosen = {kind: rng.sample(classes[kind], min(4, len(classes[kind]))) for kind in sorted(classes)}
    any_kind = sorted(chosen)[-1]
    rows, truth = [], np.zeros(cells.shape, int)
    for i, line in enumerate(cells):
        row = []
        for j, cell in enumerate(line):
            pixel, truth[i, j] = rng.choice(chosen.get(int(cell), chosen[any_kind]))
            row.append(pixel)
        rows.append(row)
    return rows, truth


def grey_pixels(meaning, white):
    levels = range(white + 1) if white < 512 else sorted({round(k * white / 511) for k in range(512)} | ({205 * white // 255} if white % 255 == 0 else set()))
    return [(level, cell) for level in levels if (cell := meaning.cell(level / white)) is not None]


class Yaml:
    """The file beside the picture, in some style."""

    def __init__(self, rng, meaning, image, style="any"):
        self.rng, self.meaning, self.style, self.notes = rng, meaning, style, []
        self.resolution = rng.choice([0.05, 0.1, 0.025, 0.2])
        self.x, self.y, self.yaw = round(rng.uniform(-50, 50), 3), round(rng.uniform(-50, 50), 3), 0.0
        self.fields = {"image": image, "resolution": repr(self.resolution), "origin": None, "negate": "1" if meaning.negate else "0",
                       "occupied_thresh": repr(meaning.occupied), "free_thresh": repr(meaning.free)}
        if meaning.mode != "trinary" or rng.random() < 0.3:
            self.fields["mode"] = rng.choice([meaning.mode, meaning.mode.capitalize(), meaning.mode.upper()])
        if meaning.occupied == 0.65 and meaning.free == 0.196 and rng.random() < 0.3:
            del self.fields["occupied_thresh"], self.fields["free_thresh"]

    def origin(self):
        yaw = self.yaw if isinstance(self.yaw, str) else repr(self.yaw)
        if self.style == "plain" or self.rng.random() < 0.7:
            return f"[{self.x}, {self.y}, {yaw}]"
        return f"\n  - {self.x}\n  - {self.y}\n  - {yaw}"

    def text(self):
        rng, fields = self.rng, {k: v for k, v in self.fields.items()}
        fields["origin"] = fields["origin"] or self.origin()
        keys = list(fields)
        if self.style == "plain":
            return "".join(f"{k}: {fields[k]}\n" for k in keys)
        if rng.random() < 0.5:
            rng.shuffle(keys)
        quote = lambda v: rng.choice([f'"{v}"', f"'{v}'"]) if not v.startswith(("[", "\n", "&", "*")) and rng.random() < 0.25 else v  # noqa: E731
        if rng.random() < 0.15 and "\n" not in fields["origin"]:
            body = "{" + ", ".join(f"{k}: {quote(fields[k])}" for k in keys) + "}\n"
        else:
            said = lambda: rng.choice(["", "", "", "  # as measured: 5", "   "])  # noqa: E731
            body = "".join(f"{k}:{'' if fields[k].startswith(chr(10)) else ' '}{quote(fields[k])}{said() if chr(10) not in fields[k] else ''}\n" for k in keys)
        body = rng.choice(["", "", "---\n", "# a map\n", "\n"]) + body + rng.choice(["", "", "...\n"])
        if rng.random() < 0.2:
            body = body.rstrip("\n")
        if rng.random() < 0.2:
            body = body.replace("\n", "\r\n")
        return ("\ufeff" if rng.random() < 0.15 else "") + body


def case_of(folder, rng, meaning, truth, data, name="m.pgm", yaml=None, **more):
    """Writes both files."""
    yaml = yaml or Yaml(rng, meaning, name, "plain")
    image = folder / name
    image.parent.mkdir(parents=True, exist_ok=True)
    image.write_bytes(data)
    (folder / "m.yaml").write_bytes(yaml.text().encode())
    return {"what": "map", "path": str(folder / "m.yaml"), "image": str(image), "cells": truth, "resolution": yaml.resolution, "x": yaml.x, "y": yaml.y,
            "near": 2 if meaning.mode == "scale" else 0, **more}


# ---- PGM

def grey(rng, meaning=None, white=None, cells=None):
    meaning = meaning or Meaning(rng)
    white = white or rng.choice([255, 255, 100, 15, 7, 254, 200])
    rows, truth = drawn(plan(rng) if cells is None else cells, grey_pixels(meaning, white), rng)
    return meaning, white, rows, truth


def pgm_bytes(folder, rng):
    meaning, white, rows, truth = grey(rng)
    return case_of(folder, rng, meaning, truth, pgm(rows, white, rng, tail=rng.choice([b"", b"", b"\n"])))


def pgm_text(folder, rng):
    meaning, white, rows, truth = grey(rng, white=rng.choice([255, 1, 9, 100, 65535, 1000]))
    return case_of(folder, rng, meaning, truth, pgm(rows, white, rng, text=True))


def pgm_16(folder, rng):
    meaning, white, rows, truth = grey(rng, white=rng.choice([65535, 256, 1000, 4095, 30000]))
    return case_of(folder, rng, meaning, truth, pgm(rows, white, rng))


def pgm_size(folder, rng):
    """Longer or shorter than the header says, or with white space behind it that is not of the pixels."""
    meaning, _, rows, truth = grey(rng, white=255)
    odd = rng.choice(["longer", "two", "shorter", "space", "numbers", "few numbers", "empty", "head alone"])
    data = pgm(rows, 255, rng)
    if odd == "longer":
        return case_of(folder, rng, meaning, truth, data + bytes(rng.randrange(3, 300)), say="longer")
    if odd == "two":
        return case_of(folder, rng, meaning, truth, data + data, say="longer")
    if odd == "shorter":
        return case_of(folder, rng, meaning, None, data[:-rng.randrange(1, truth.size + 1)], refusal="ends early|expected")
    if odd == "space":
        head = f"P5{rng.choice([' ', chr(10)])}{truth.shape[1]} {truth.shape[0]}\n255{rng.choice([' ', chr(9), ''])}{rng.choice([chr(10), chr(13) + chr(10), '  '])}"
        return case_of(folder, rng, meaning, truth, pgm(rows, 255, rng, head=head.encode()))
    if odd == "numbers":
        return case_of(folder, rng, meaning, truth, pgm(rows, 255, rng, text=True, tail=b"0 0 0 254\n"), say="more pixels")
    if odd == "few numbers":
        short = pgm(rows, 255, rng, text=True, head=f"P2\n{truth.shape[1]} {truth.shape[0]}\n255\n".encode())
        return case_of(folder, rng, meaning, None, short[:len(short) // 2], refusal="early|above")
    return case_of(folder, rng, meaning, None, b"" if odd == "empty" else b"P5\n7 5\n", refusal="empty|expected|early")


def pgm_above_white(folder, rng):
    """A header whose white is darker than the lightest pixel: nobody knows what that means."""
    text = rng.random() < 0.5
    meaning, white, rows, truth = grey(rng, white=rng.choice([100, 127, 200, 1000]))
    row, column = rng.randrange(len(rows)), rng.randrange(len(rows[0]))
    rows[row][column] = rng.randrange(white + 1, 256 if white < 256 else 65536)
    return case_of(folder, rng, meaning, None, pgm(rows, white, rng, text=text), refusal="above its white", say="above its white")


# ---- PNG

def png_pixels(rng, meaning, colour, depth, count=300):
    """(samples, cell) of that kind of PNG, without palettes."""
    white = (1 << depth) - 1
    grown = []
    for _ in range(count):
        grey_level = rng.randrange(white + 1) if rng.random() < 0.7 or white % 255 else 205 * white // 255
        tones = [grey_level] if CHANNELS[colour] < 3 else [grey_level] * 3 if rng.random() < 0.5 else [rng.choice([0, white, rng.randrange(white + 1)]) for _ in range(3)]
        alpha = [] if CHANNELS[colour] % 2 else [rng.choice([white, white, 0, rng.randrange(white + 1)])]
        cell = UNKNOWN if alpha and alpha[0] < (white + 1) // 2 else meaning.cell(sum(tones) / len(tones) / white)
        if cell is not None:
            grown.append((tuple(tones + alpha), cell))
    return grown


def png_case(folder, rng, colour, ancillary=None, interlaced=None, meaning=None, cells=None):
    meaning = meaning or Meaning(rng)
    depth = rng.choice(DEPTHS[colour])
    pixels = png_pixels(rng, meaning, colour, depth)
    if depth == 1 and not pixels:
        return None
    extra = list(shown(rng) if ancillary is None else ancillary)
    if colour in (0, 2) and rng.random() < 0.3:  # one colour is clear
        clear = rng.choice(pixels)[0]
        pixels = [(p, UNKNOWN if p == clear else c) for p, c in pixels]
        extra.append((b"tRNS", struct.pack(f">{len(clear)}H", *clear)))
    if rng.random() < 0.3:
        extra += rng.choice([[(b"pHYs", struct.pack(">IIB", 2835, 2835, 1))], [(b"tEXt", b"Comment\0odd")], [(b"bKGD", bytes(6 if colour in (2, 6) else 2))],
                             [(b"vpAg", bytes(9))]])
    rows, truth = drawn(plan(rng) if cells is None else cells, pixels, rng)
    data = png(rows, depth, colour, rng, extra, rng.random() < 0.3 if interlaced is None else interlaced)
    return case_of(folder, rng, meaning, truth, data, "m.png")


def png_grey(folder, rng):
    return png_case(folder, rng, 0, ())


def png_gamma(folder, rng):
    """Of every kind, with what says how a screen shows it."""
    said = shown(rng)
    gamma = [(b"gAMA", struct.pack(">I", rng.choice([22727, 55556, 100000, 220000]))), *[c for c in said if c[0] != b"gAMA"]]
    return png_case(folder, rng, rng.choice([0, 2, 4, 6]), gamma)


def png_colour(folder, rng):
    return png_case(folder, rng, 2)


def png_alpha(folder, rng):
    return png_case(folder, rng, rng.choice([4, 6]))


def png_interlaced(folder, rng):
    small = plan(rng, rng.randrange(2, 10), rng.randrange(2, 10)) if rng.random() < 0.5 else None
    return png_case(folder, rng, rng.choice([0, 2, 4, 6]), None, True, cells=small)


def png_palette(folder, rng):
    meaning, depth = Meaning(rng), rng.choice(DEPTHS[3])
    colours, cells, alphas = [], [], []
    while len(colours) < (1 << depth):
        tones = [rng.choice([0, 255, 205, rng.randrange(256)])] * 3 if rng.random() < 0.6 else [rng.randrange(256) for _ in range(3)]
        cell = meaning.cell(sum(tones) / 765)
        if cell is not None:
            alphas.append(rng.choice([255, 255, 0, 127, 128]))
            colours.append(tones)
            cells.append(cell)
    extra = [*shown(rng), (b"PLTE", bytes(v for c in colours for v in c))]
    if rng.random() < 0.4:
        said = rng.randrange(1, len(colours) + 1)
        extra.append((b"tRNS", bytes(alphas[:said])))
        cells = [UNKNOWN if i < said and alphas[i] < 128 else cell for i, cell in enumerate(cells)]
    rows, truth = drawn(plan(rng), [((i,), cell) for i, cell in enumerate(cells)], rng)
    if rng.random() < 0.1 and depth == 8:  # a pixel of a colour that the palette has not
        extra = [(n, d[:600] if n == b"PLTE" else d[:200]) for n, d in extra]
        rows[0][0] = (rng.randrange(200, 256),)
        return case_of(folder, rng, meaning, None, png(rows, depth, 3, rng, extra), "m.png", refusal="palette")
    return case_of(folder, rng, meaning, truth, png(rows, depth, 3, rng, extra, rng.random() < 0.3), "m.png")


def png_damaged(folder, rng):
    """Cut, or with a wrong checksum where it matters; longer behind its end is nothing to speak of."""
    made = png_case(folder, rng, rng.choice([0, 2]), ())
    data = open(made["image"], "rb").read()
    odd = rng.choice(["cut", "spoiled", "longer", "odd chunk"])
    if odd == "longer":
        data += bytes(20)
    elif odd == "odd chunk":  # what is not needed to read it may be broken
        data = data[:33] + chunk(b"tEXt", b"x\0y")[:-1] + b"\0" + data[33:]
    else:
        begin = data.index(b"IDAT") + 4
        cut = rng.randrange(begin, len(data) - 24) if len(data) - 24 > begin else begin
        data = data[:cut] if odd == "cut" else data[:cut] + bytes([data[cut] ^ 255]) + data[cut + 1:]
        made["refusal"] = "PNG"
    open(made["image"], "wb").write(data)
    return made


# ---- YAML

def yaml_forms(folder, rng):
    meaning, white, rows, truth = grey(rng, Meaning(rng, negate=rng.random() < 0.2))
    yaml = Yaml(rng, meaning, "m.pgm")
    more = {}
    odd = rng.choice(["", "", "unknown", "bool", "anchor", "number", "twice"])
    if odd == "unknown":
        yaml.fields[rng.choice(["map_name", "date", "building_id", "lethal_cost_threshold", "type"])] = rng.choice(["ground floor", "5", "[1, 2]", "{a: 1}"])
        more["say"] = "not known"
    elif odd == "bool":
        yaml.fields["negate"] = rng.choice(["true", "True", "yes", "on"] if meaning.negate else ["false", "False", "FALSE", "no", "off"])
    elif odd == "anchor":
        yaml.fields["resolution"], yaml.style, yaml.fields["unit"] = f"&r {yaml.resolution}", "plain", "*r"
    elif odd == "number":
        yaml.fields["resolution"] = rng.choice([f"+{yaml.resolution}", f"{yaml.resolution}000", f"{yaml.resolution * 1000:.6g}e-3", str(yaml.resolution)[1:]])
    made = case_of(folder, rng, meaning, truth, pgm(rows, white, rng), yaml=yaml, **more)
    if odd == "twice":
        text = f"resolution: {yaml.resolution}\n" + yaml.text().replace("\ufeff", "").replace("\r", "")
        if "{" not in text and "---" not in text:  # a second line of a key fits into no {…}
            text = text.replace(f"resolution: {yaml.resolution}", "resolution: 0.35", 1) if rng.random() < 0.5 else text.rstrip().rstrip(".") + "\nresolution: 0.35\n"
            open(made["path"], "w").write(text)
            made.update(cells=None, refusal="twice", say="twice")
    return made


def yaml_modes(folder, rng):
    meaning = Meaning(rng, rng.choice(["scale", "raw", "trinary"]), rng.random() < 0.4)
    if rng.random() < 0.5:
        return png_case(folder, rng, rng.choice([0, 2, 4, 6]), meaning=meaning)
    meaning, white, rows, truth = grey(rng, meaning)
    return case_of(folder, rng, meaning, truth, pgm(rows, white, rng), yaml=Yaml(rng, meaning, "m.pgm"))


def yaml_path(folder, rng):
    meaning, white, rows, truth = grey(rng)
    name = rng.choice(["sub/m.pgm", "../m.pgm", "./m.pgm", "a b/m 1.pgm", "étage/m.pgm", "m.PGM", "m", "m.png", "sub/../m.pgm", "absolute", "gone.pgm", "C:\\maps\\m.pgm", "/home/else/m.pgm"])
    said = str(folder / "m.pgm") if name == "absolute" else name
    base = folder / "in"
    (base / "sub").mkdir(parents=True)
    if name in ("gone.pgm", "C:\\maps\\m.pgm", "/home/else/m.pgm"):
        made = case_of(base, rng, meaning, None, pgm(rows, white, rng), yaml=Yaml(rng, meaning, said), refusal="image .*(gone.pgm|m.pgm)|not valid YAML")
        return made
    return case_of(base, rng, meaning, truth, pgm(rows, white, rng), said if name == "absolute" else name, yaml=Yaml(rng, meaning, said))


def yaml_yaw(folder, rng):
    """A rest of rounding is no turn; a real one is applied. Judged by the middles of what was all one in 5 x 5 cells."""
    meaning = Meaning(rng)
    meaning, white, rows, truth = grey(rng, meaning, cells=plan(rng, rng.randrange(14, 40), rng.randrange(14, 30)))
    yaml = Yaml(rng, meaning, "m.pgm", "plain")
    odd = rng.choice(["tiny", "tiny", "nan", "real", "real", "turn"])
    yaml.yaw = {"tiny": rng.choice([-1e-6, 1e-9, 3e-5, -0.0, 6.283185307]), "nan": rng.choice(["-nan", "nan", ".nan"]), "real": round(rng.uniform(-3.1, 3.1), 4),
                "turn": rng.choice([math.pi / 2, -math.pi / 2, math.pi])}[odd]
    made = case_of(folder, rng, meaning, truth, pgm(rows, white, rng), yaml=yaml)
    if odd in ("real", "turn"):
        made.update(yaw=yaml.yaw, say="turned")
    return made


def yaml_wrong(folder, rng):
    """What cannot be read: a fault that names the key."""
    meaning, white, rows, _ = grey(rng)
    yaml = Yaml(rng, meaning, "m.pgm", "plain")
    key, value = rng.choice([("resolution", "0"), ("resolution", "-0.05"), ("resolution", "0,05"), ("resolution", "five"), ("resolution", ".nan"), ("resolution", "0.05 m"),
                             ("origin", "[0, 0]"), ("origin", "[0, 0, 0, 0, 0, 0]"), ("origin", "{x: 0, y: 0}"), ("origin", "[0, .inf, 0]"), ("origin", "[a, 0, 0]"),
                             ("origin", "0 0 0"), ("negate", "2"), ("negate", "maybe"), ("mode", "gray"), ("occupied_thresh", "65"), ("free_thresh", "0.9"), ("image", "")])
    yaml.fields[key] = value
    made = case_of(folder, rng, meaning, None, pgm(rows, white, rng), yaml=yaml, refusal=key.replace("free_thresh", "thresh") + r"|m.yaml:\d+: ")
    if rng.random() < 0.2:
        text = rng.choice([b"", b"\0\1\2", b"[1, 2", b"- image\n", "image: m.pgm\n".encode("utf-16"), b"image: m.pgm\n"])
        open(made["path"], "wb").write(text)
        made["refusal"] = "m.yaml"
    return made


def other_images(folder, rng):
    meaning = Meaning(rng)
    kind = rng.choice(sorted(OTHERS))
    name = rng.choice(["m.pgm", "m.png", "m.bmp", "m"])
    said = {"bitmap": "bitmap", "gzip": "gzip"}.get(kind, kind.strip())
    return case_of(folder, rng, meaning, None, OTHERS[kind], name, refusal=said)


def tiny(folder, rng):
    """A pixel, a row, a column."""
    columns, rows = rng.choice([(1, 1), (1, 1), (2, 2), (1, rng.randrange(2, 40)), (rng.randrange(2, 40), 1)])
    cells = np.array([[rng.choice([UNKNOWN, FREE, WALL]) for _ in range(columns)] for _ in range(rows)])
    if rng.random() < 0.5:
        return png_case(folder, rng, rng.choice([0, 2, 4, 6]), cells=cells)
    text = rng.random() < 0.4
    meaning, white, drawn_rows, truth = grey(rng, cells=cells)
    return case_of(folder, rng, meaning, truth, pgm(drawn_rows, white, rng, text=text))


def huge(folder, rng):
    """Some rooms in a picture most of which is unknown: only the part that is known is kept."""
    meaning = Meaning(rng, usual=True)
    cells = plan(rng)
    shades = np.where(cells == UNKNOWN, 205, np.where(cells == WALL, 0, 254)).astype(np.uint8)
    height, columns = rng.choice([(5200, 5000), (2600, 10000), (9000, 3000)])
    top, left = rng.randrange(40, height - 90), rng.randrange(40, columns - 90)
    whole = np.full((height, columns), 205, np.uint8)
    whole[top:top + cells.shape[0], left:left + cells.shape[1]] = shades
    truth = np.where(shades == 205, UNKNOWN, np.where(shades == 0, WALL, FREE))
    made = case_of(folder, rng, meaning, truth, f"P5 {columns} {height} 255\n".encode() + whole.tobytes(), say="what is known")
    made.update(part=(left, height - top - cells.shape[0]))
    return made


KINDS = {"PGM, bytes": pgm_bytes, "PGM, text": pgm_text, "PGM, 16 bits": pgm_16, "PGM, longer or shorter": pgm_size, "PGM, above its white": pgm_above_white,
         "PNG, grey": png_grey, "PNG, colours": png_colour, "PNG, palette": png_palette, "PNG, alpha": png_alpha, "PNG, gamma and profile": png_gamma,
         "PNG, interlaced": png_interlaced, "PNG, damaged": png_damaged, "YAML, styles": yaml_forms, "YAML, modes": yaml_modes, "YAML, paths": yaml_path,
         "YAML, yaw": yaml_yaw, "YAML, impossible": yaml_wrong, "other pictures": other_images, "tiny": tiny, "huge": huge}
