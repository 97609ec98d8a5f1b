import { expect, test } from 'vitest';
import type { MuseumDraft, Point } from '../lib/protocol';
import { addExhibit, addHazard, addRoom, addTour, addViewpoint, crossesItself, handlesOf, hoursOf, moveAll, moveHandle, remove, removeHandle, renamedExhibit, splitSide, stopsOf, timesOf, withHours, withRoom, withTour } from './draft';

const square: Point[] = [[0, 0], [2, 0], [2, 2], [0, 2]];
const draft: MuseumDraft = {
  area: [[0, 0], [9, 0], [9, 7], [0, 7]],
  hazards: [{ id: 'case', kind: 'glass', polygon: square }],
  home: [1, 5, 0],
  charger: null,
  exhibits: [],
  tours: [],
  rooms: [],
  hours: { open: [], web: [], closed: [] },
};
const hazard = { kind: 'hazard', index: 0 } as const;

test('corners and the middles of sides are handles', () => {
  const handles = handlesOf(draft, hazard);
  expect(handles.filter(({ kind }) => kind === 'corner').map(({ at }) => at)).toEqual(square);
  expect(handles.find(({ key }) => key === 'middle:3')?.at).toEqual([0, 1]);
});
test('a corner moves to the millimetre, and the old draft stays', () => {
  const moved = moveHandle(draft, hazard, { kind: 'corner', index: 2 }, [3.00049, 2.5]);
  expect(moved.hazards[0].polygon[2]).toEqual([3, 2.5]);
  expect(draft.hazards[0].polygon[2]).toEqual([2, 2]);
});
test('a side is split, and a corner taken away, but three remain', () => {
  let next = splitSide(draft, hazard, 3);
  expect(next.hazards[0].polygon).toEqual([...square, [0, 1]]);
  for (let i = 0; i < 9; ++i) next = removeHandle(next, hazard, { kind: 'corner', index: 0 });
  expect(next.hazards[0].polygon.length).toBe(3);
});
test('a whole hazard moves, and goes', () => {
  expect(moveAll(draft, hazard, [1, -1]).hazards[0].polygon[0]).toEqual([1, -1]);
  expect(remove(draft, hazard).hazards).toEqual([]);
});
test('new hazards have names of their own', () => {
  const two = addHazard(addHazard(draft, square), square);
  expect(two.hazards.map(({ id }) => id)).toEqual(['case', 'hazard-1', 'hazard-2']);
});
test('an exhibit is placed, turned, and looked at from viewpoints', () => {
  let next = addExhibit(draft, [4, 4], ['en', 'de'], 'New');
  const exhibit = { kind: 'exhibit', index: 0 } as const;
  expect(next.exhibits[0].title).toEqual({ en: 'New', de: 'New' });
  expect(next.exhibits[0].pose).toEqual([4, 3, Math.PI / 2]);
  next = moveHandle(next, exhibit, { kind: 'heading', index: -1 }, [9, 3]);
  expect(next.exhibits[0].pose[2]).toBe(0);
  next = addViewpoint(next, 0, [4, 6]);
  expect(next.exhibits[0].viewpoints[0][2]).toBeCloseTo(-Math.PI / 2);
  next = moveHandle(next, exhibit, { kind: 'viewpoint', index: 0 }, [6, 4]);
  expect(Math.abs(next.exhibits[0].viewpoints[0][2])).toBeCloseTo(Math.PI);
  expect(removeHandle(next, exhibit, { kind: 'viewpoint', index: 0 }).exhibits[0].viewpoints).toEqual([]);
});
test('polygons that cross themselves are known', () => {
  expect(crossesItself(square)).toBe(false);
  expect(crossesItself([[0, 0], [2, 2], [2, 0], [0, 2]])).toBe(true);
  expect(crossesItself([[0, 0], [1, 0], [0, 1]])).toBe(false);
});

test('a tour is whole without a stop, and follows its exhibits', () => {
  let next = addExhibit(addExhibit(addTour(draft, ['en'], 'New tour'), [1, 1], ['en'], 'One'), [2, 2], ['en'], 'Two');
  expect(next.tours).toEqual([{ id: 'tour-1', title: { en: 'New tour' }, exhibits: [], minutes: 15, daily: [] }]);
  next = withTour(next, 0, stopsOf(['exhibit-1', 'exhibit-2']));
  expect(next.tours[0].minutes).toBeNull();
  next = renamedExhibit(next, 1, 'clock');
  expect(next.tours[0].exhibits).toEqual(['exhibit-1', 'clock']);
  next = remove(next, { kind: 'exhibit', index: 0 });
  expect(next.tours[0].exhibits).toEqual(['clock']);
  expect(remove(next, { kind: 'exhibit', index: 0 }).tours).toEqual([]);
  expect(remove(next, { kind: 'tour', index: 0 }).tours).toEqual([]);
  expect(handlesOf(next, { kind: 'tour', index: 0 })).toEqual([]);
});
test('times of day are read as people write them, and rise', () => {
  expect(timesOf('16:30, 9.05 9:05')).toEqual(['09:05', '16:30']);
  expect(timesOf('')).toEqual([]);
  for (const wrong of ['2 pm', '24:00', '12:60', '14']) expect(timesOf(wrong)).toBeNull();
});
test('a room is named where it is, moved, and taken away', () => {
  const room = { kind: 'room', index: 0 } as const;
  let next = addRoom(draft, [2.0004, 3], ['en', 'fr'], 'New room');
  expect(next.rooms).toEqual([{ id: 'room-1', name: { en: 'New room', fr: 'New room' }, at: [2, 3] }]);
  const [handle] = handlesOf(next, room);
  next = moveHandle(next, room, handle, [4, 5]);
  next = moveAll(next, room, [1, 1]);
  expect(withRoom(next, 0, { id: 'hall' }).rooms[0]).toMatchObject({ id: 'hall', at: [5, 6] });
  expect(remove(next, room).rooms).toEqual([]);
});
test('hours are read as people write them', () => {
  expect(hoursOf('13:30-18, 9-12')).toEqual(['09:00-12:00', '13:30-18:00']);
  expect(hoursOf('22:00 – 6:00')).toEqual(['22:00-06:00']);
  expect(hoursOf('0-24')).toEqual(['00:00-24:00']);
  expect(hoursOf('')).toEqual([]);
  for (const wrong of ['9', '9-25', '9-9', '9:60-10', 'nine-ten', '9-12 13-14']) expect(hoursOf(wrong)).toBeNull();
  expect(withHours(draft, { web: ['18:00-22:00'] }).hours).toEqual({ open: [], web: ['18:00-22:00'], closed: [] });
});
