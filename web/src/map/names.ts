/** Where the name of an exhibit stands beside its marker. */
export type Side = 'below' | 'above' | 'right' | 'left';

export interface Named {
  id: string;
  /** Centre of the marker [px]. */
  x: number;
  y: number;
  /** Of the name [px]. */
  width: number;
}
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const MARKER = 20; // half a marker with its rim [px]
const HEIGHT = 17; // of a name [px]; style.css places it accordingly

const boxes: Record<Side, (name: Named) => Box> = {
  below: ({ x, y, width }) => ({ left: x - width / 2, top: y + MARKER, right: x + width / 2, bottom: y + MARKER + HEIGHT }),
  above: ({ x, y, width }) => ({ left: x - width / 2, top: y - MARKER - HEIGHT, right: x + width / 2, bottom: y - MARKER }),
  right: ({ x, y, width }) => ({ left: x + MARKER, top: y - HEIGHT / 2, right: x + MARKER + width, bottom: y + HEIGHT / 2 }),
  left: ({ x, y, width }) => ({ left: x - MARKER - width, top: y - HEIGHT / 2, right: x - MARKER, bottom: y + HEIGHT / 2 }),
};
const meet = (a: Box, b: Box) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/**
 * Gives each name in turn the first side on which it covers no marker, none of the `others` [px], no name before it and
 * stays in the area; a name without such a side is left out. So the important ones come first.
 */
export function placeNames(names: Named[], area: Box, others: Box[] = []): Map<string, Side> {
  const taken: { id: string; box: Box }[] = names.map(({ id, x, y }) => ({
    id,
    box: { left: x - MARKER, top: y - MARKER, right: x + MARKER, bottom: y + MARKER },
  }));
  for (const box of others) taken.push({ id: '', box });
  const sides = new Map<string, Side>();
  for (const name of names) {
    for (const side of Object.keys(boxes) as Side[]) {
      const box = boxes[side](name);
      const isInside = box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom;
      if (!isInside || taken.some((other) => other.id !== name.id && meet(other.box, box))) continue;
      taken.push({ id: `${name.id} name`, box });
      sides.set(name.id, side);
      break;
    }
  }
  return sides;
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
