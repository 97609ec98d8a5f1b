/**
 * Outlines of the cells for which `inside` holds, as closed lines in cell coordinates (x right, y down). The staircase
 * of a slanted wall becomes the slanted wall again.
 */
export function contoursOf(columns: number, rows: number, inside: (x: number, y: number) => boolean): number[][] {
  const width = columns + 1;
  // Directed edges along cell borders with the inside on the right; up to two leave a corner.
  const next = new Map<number, number[]>();
  const add = (ax: number, ay: number, bx: number, by: number) => {
    const a = ay * width + ax;
    const list = next.get(a);
    if (list) list.push(by * width + bx);
    else next.set(a, [by * width + bx]);
  };
  for (let y = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) {
      if (!inside(x, y)) continue;
      if (y === 0 || !inside(x, y - 1)) add(x, y, x + 1, y);
      if (x === columns - 1 || !inside(x + 1, y)) add(x + 1, y, x + 1, y + 1);
      if (y === rows - 1 || !inside(x, y + 1)) add(x + 1, y + 1, x, y + 1);
      if (x === 0 || !inside(x - 1, y)) add(x, y + 1, x, y);
    }
  }
  const loops: number[][] = [];
  for (const start of next.keys()) {
    while (next.get(start)?.length) {
      const corners: number[] = [start];
      let at = next.get(start)!.pop()!;
      while (at !== start) {
        corners.push(at);
        const ways = next.get(at)!;
        at = ways.pop()!;
      }
      const points: number[] = [];
      for (let i = 0; i < corners.length; ++i) {
        const a = corners[i];
        const b = corners[(i + 1) % corners.length];
        // The middles of the edges: a staircase becomes a straight line at once.
        points.push(((a % width) + (b % width)) / 2, (Math.floor(a / width) + Math.floor(b / width)) / 2);
      }
      const simple = simplified(points, 1.2);
      if (simple.length >= 6) loops.push(simple);
    }
  }
  return loops;
}

/** Douglas and Peucker for a closed line: no point lies further than `tolerance` from the result. */
function simplified(points: number[], tolerance: number): number[] {
  const count = points.length / 2;
  if (count < 5) return points;
  let far = 0;
  let best = 0;
  for (let i = 1; i < count; ++i) {
    const d = Math.hypot(points[2 * i] - points[0], points[2 * i + 1] - points[1]);
    if (d > best) [best, far] = [d, i];
  }
  const keep = new Uint8Array(count + 1);
  keep[0] = keep[far] = keep[count] = 1;
  const spans: [number, number][] = [
    [0, far],
    [far, count],
  ];
  while (spans.length > 0) {
    const [a, b] = spans.pop()!;
    const ax = points[2 * a];
    const ay = points[2 * a + 1];
    const bx = points[2 * (b % count)];
    const by = points[2 * (b % count) + 1];
    const length = Math.hypot(bx - ax, by - ay) || 1e-9;
    let worst = tolerance;
    let at = -1;
    for (let i = a + 1; i < b; ++i) {
      const d = Math.abs((bx - ax) * (points[2 * i + 1] - ay) - (by - ay) * (points[2 * i] - ax)) / length;
      if (d > worst) [worst, at] = [d, i];
    }
    if (at >= 0) {
      keep[at] = 1;
      spans.push([a, at], [at, b]);
    }
  }
  const result: number[] = [];
  for (let i = 0; i < count; ++i) if (keep[i]) result.push(points[2 * i], points[2 * i + 1]);
  return result;
}
