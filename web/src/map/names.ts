/** A rectangle of the page [px]. */
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}
export interface Named {
  id: string;
  /** Centre of the marker [px]. */
  x: number;
  y: number;
  /** Of the name [px]. */
  width: number;
  /** It is shown even where it has to cover something. */
  matters: boolean;
}
export interface Place {
  /** Corner of the name, seen from the centre of its marker [px]. */
  dx: number;
  dy: number;
  /** Nothing is covered. */
  isFree: boolean;
}

export const MARKER = 20; // half a marker with its rim [px]
const END = 12; // from its end to below the marker's middle [px]
const HEIGHT = 17; // of a name as style.css draws it [px]

/** So far to both sides of a point, and up and down. */
export const around = ([x, y]: number[], wide: number, tall = wide): Box => ({ left: x - wide, top: y - tall, right: x + wide, bottom: y + tall });
export const meet = (a: Box, b: Box) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/**
 * Gives each name in turn the first place beside its marker that covers no marker, none of the `others`, no name before
 * it, and lies in the area; so what matters comes first. Without such a place it lies below, for those who point at it.
 */
export function placeNames(names: Named[], area: Box, others: Box[] = []): Map<string, Place> {
  const taken: { id: string; box: Box }[] = others.map((box) => ({ id: '', box }));
  for (const { id, x, y } of names) {
    taken.push({ id, box: { left: x - MARKER, top: y - MARKER, right: x + MARKER, bottom: y + MARKER } });
  }
  const places = new Map<string, Place>();
  for (const { id, x, y, width, matters } of names) {
    // At the rim of the page a name slides along its marker.
    const slid = Math.max(area.left, Math.min(area.right - width, x - width / 2));
    const [below, above, beside] = [y + MARKER, y - MARKER - HEIGHT, y - HEIGHT / 2];
    const corners = [[x - width / 2, below], [x - width / 2, above], [x + MARKER, beside], [x - MARKER - width, beside], [slid, below], [slid, above]];
    // Begun or ended at the marker, it leaves its neighbour room.
    for (const left of [x - END, x - width + END]) corners.push([left, below], [left, above]);
    const boxes = corners.map(([left, top]) => ({ left, top, right: left + width, bottom: top + HEIGHT }));
    // A marker beyond the rim has none there: nobody would know whose it is.
    const isSeen = x >= area.left && x <= area.right && y >= area.top && y <= area.bottom;
    const free = boxes.find(
      (box) =>
        isSeen && box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom &&
        !taken.some((other) => other.id !== id && meet(other.box, box)),
    );
    const box = free ?? boxes[4];
    if (free || (matters && isSeen)) taken.push({ id: '', box });
    places.set(id, { dx: box.left - x, dy: box.top - y, isFree: free !== undefined });
  }
  return places;
}

const brush = document.createElement('canvas').getContext('2d')!;
const widths = new Map<string, number>();

/** Width of a name as style.css draws it [px]. */
export function widthOf(text: string): number {
  let width = widths.get(text);
  if (width === undefined) {
    brush.font = `650 11.2px ${getComputedStyle(document.documentElement).fontFamily}`;
    widths.set(text, (width = Math.ceil(brush.measureText(text).width) + 16));
  }
  return width;
}
