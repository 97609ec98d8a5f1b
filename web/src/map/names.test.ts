import { expect, test, vi } from 'vitest';

vi.stubGlobal('document', { createElement: () => ({ getContext: () => null }) });
const { placeNames } = await import('./names');
const area = { left: 0, top: 0, right: 360, bottom: 500 };
const named = (id: string, x: number, y: number, width = 100) => ({ id, x, y, width, matters: false });

test('a marker beyond the rim has no name there, and takes no place from others', () => {
  const places = placeNames([named('gone', -30, 200), named('seen', 60, 200)], area);
  expect(places.get('gone')?.isFree).toBe(false);
  expect(places.get('seen')?.isFree).toBe(true);
});
test('between close neighbours a name ends or begins at its marker', () => {
  // Rows of markers above and below, so near that a centred name would cover one of them.
  const row = [named('a', 100, 100, 90), named('b', 145, 131, 90), named('c', 55, 131, 90), named('d', 145, 69, 90), named('e', 55, 69, 90)];
  expect(placeNames(row, area).get('b')?.isFree).toBe(true);
  expect(placeNames(row, area).get('c')?.isFree).toBe(true);
});
test('no name covers a marker or another name', () => {
  const many = Array.from({ length: 20 }, (_, i) => named(`${i}`, 30 + (i % 5) * 75, 60 + Math.floor(i / 5) * 110, 80 + (i % 3) * 20));
  const places = placeNames(many, area);
  const boxes = many.filter(({ id }) => places.get(id)?.isFree).map(({ id, x, y, width }) => {
    const { dx, dy } = places.get(id)!;
    return { left: x + dx, top: y + dy, right: x + dx + width, bottom: y + dy + 17 };
  });
  expect(boxes.length).toBeGreaterThan(10);
  boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => expect(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom).toBe(false)));
});
