"""The reliability diagram of P(lost): what the robot said against how often it was so, as SVG."""
import os

SIZE, LEFT, TOP = 420, 70, 86
STYLE = ("text{font:11px sans-serif;fill:#222}.title{font:bold 14px sans-serif}.tick{fill:#777}.grid{stroke:#ddd}"
         ".ideal{stroke:#222}.bound{fill:#3d7dd8;opacity:.12}.curve{fill:none;stroke:#3d7dd8;stroke-width:2}.bin{fill:#3d7dd8}")


def plot(path, curve, bound, subtitles):
    """`curve`: (mean P(lost), share lost) of each bin; `bound`: how far a bin may be off; two lines of text."""
    x = lambda value: LEFT + SIZE * value
    y = lambda value: TOP + SIZE * (1.0 - value)
    points = lambda pairs: " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in pairs)
    band = [(0, 0), (0, bound), (1 - bound, 1), (1, 1), (1, 1 - bound), (bound, 0)]
    parts = [f'<polygon points="{points(band)}" class="bound"/>']
    for tick in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0):
        parts.append(f'<line x1="{x(tick):.1f}" y1="{y(0)}" x2="{x(tick):.1f}" y2="{y(1)}" class="grid"/>')
        parts.append(f'<line x1="{x(0)}" y1="{y(tick):.1f}" x2="{x(1)}" y2="{y(tick):.1f}" class="grid"/>')
        parts.append(f'<text x="{x(tick):.1f}" y="{y(0) + 16}" class="tick" text-anchor="middle">{tick:g}</text>')
        parts.append(f'<text x="{x(0) - 8}" y="{y(tick) + 4:.1f}" class="tick" text-anchor="end">{tick:g}</text>')
    parts.append(f'<line x1="{x(0)}" y1="{y(0)}" x2="{x(1)}" y2="{y(1)}" class="ideal"/>')
    parts.append(f'<polyline points="{points(curve)}" class="curve"/>')
    parts += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="4" class="bin"/>' for a, b in curve]
    width, height = LEFT + SIZE + 40, TOP + SIZE + 60
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
            f'<style>{STYLE}</style><rect width="100%" height="100%" fill="#fff"/>'
            f'<text x="20" y="26" class="title">Does the robot know when it is lost?</text>'
            + "".join(f'<text x="20" y="{46 + 16 * i}">{line}</text>' for i, line in enumerate(subtitles)))
    tail = (f'<text x="{x(0.5)}" y="{y(0) + 38}" text-anchor="middle">P(lost), as the robot says</text>'
            f'<text transform="translate({LEFT - 44} {y(0.5)}) rotate(-90)" text-anchor="middle">share of the updates that were lost</text>')
    beside = path.with_suffix(f".part{os.getpid()}")
    beside.write_text(head + "".join(parts) + tail + "</svg>\n", encoding="utf-8")
    beside.rename(path)
