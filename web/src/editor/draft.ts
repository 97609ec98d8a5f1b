// A draft of a museum: handles on its map, and what becomes of it when one of them is moved. Nothing here changes a draft:
// each function gives a new one. Metres and radians in the map's frame.
import type { Exhibit, Hazard, MuseumDraft, OpeningHours, Point, Pose, RoomName, Tour } from '../lib/protocol';

export type Selection = { kind: 'area' | 'home' | 'charger' | 'hours' } | { kind: 'hazard' | 'exhibit' | 'tour' | 'room'; index: number };
export interface Handle {
  /** Names it among those of what is selected. */
  key: string;
  kind: 'corner' | 'middle' | 'pose' | 'heading' | 'look' | 'viewpoint' | 'place';
  at: Point;
  /** Of corners and viewpoints. */
  index: number;
}

/** [m] from a pose to the handle that turns it. */
export const ARM = 0.9;
const LEAST_CORNERS = 3;

const rounded = (value: number) => Math.round(value * 1000) / 1000;
const at = (point: Point): Point => [rounded(point[0]), rounded(point[1])];
const ahead = (pose: Pose): Point => [pose[0] + ARM * Math.cos(pose[2]), pose[1] + ARM * Math.sin(pose[2])];
const towards = (from: Point | Pose, to: Point) => Math.atan2(to[1] - from[1], to[0] - from[0]);
const middle = (a: Point, b: Point): Point => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

/** The corners of what is selected; undefined: it has none. */
export function cornersOf(draft: MuseumDraft, selection: Selection): Point[] | undefined {
  if (selection.kind === 'area') return draft.area;
  return selection.kind === 'hazard' ? draft.hazards[selection.index]?.polygon : undefined;
}

export function handlesOf(draft: MuseumDraft, selection: Selection): Handle[] {
  const corners = cornersOf(draft, selection);
  if (corners)
    return corners.flatMap((corner, index): Handle[] => [
      { key: `corner:${index}`, kind: 'corner', at: corner, index },
      { key: `middle:${index}`, kind: 'middle', at: middle(corner, corners[(index + 1) % corners.length]), index },
    ]);
  const room = roomOf(draft, selection);
  if (room) return [{ key: 'place', kind: 'place', at: room.at, index: -1 }];
  const pose = poseOf(draft, selection);
  if (!pose) return [];
  const handles: Handle[] = [
    { key: 'pose', kind: 'pose', at: [pose[0], pose[1]], index: -1 },
    { key: 'heading', kind: 'heading', at: ahead(pose), index: -1 },
  ];
  if (selection.kind === 'exhibit') {
    const exhibit = draft.exhibits[selection.index];
    handles.push({ key: 'look', kind: 'look', at: exhibit.look_at, index: -1 });
    exhibit.viewpoints.forEach((viewpoint, index) =>
      handles.push({ key: `viewpoint:${index}`, kind: 'viewpoint', at: [viewpoint[0], viewpoint[1]], index }),
    );
  }
  return handles;
}

export const roomOf = (draft: MuseumDraft, selection: Selection): RoomName | undefined => (selection.kind === 'room' ? draft.rooms[selection.index] : undefined);
/** Where the robot stands for what is selected. */
export function poseOf(draft: MuseumDraft, selection: Selection): Pose | null | undefined {
  switch (selection.kind) {
    case 'home':
      return draft.home;
    case 'charger':
      return draft.charger;
    case 'exhibit':
      return draft.exhibits[selection.index]?.pose;
  }
  return undefined;
}

function withCorners(draft: MuseumDraft, selection: Selection, corners: Point[]): MuseumDraft {
  if (selection.kind === 'area') return { ...draft, area: corners };
  if (selection.kind !== 'hazard') return draft;
  return withHazard(draft, selection.index, { polygon: corners });
}
export function withHazard(draft: MuseumDraft, index: number, change: Partial<Hazard>): MuseumDraft {
  return { ...draft, hazards: draft.hazards.map((hazard, i) => (i === index ? { ...hazard, ...change } : hazard)) };
}
export function withExhibit(draft: MuseumDraft, index: number, change: Partial<Exhibit>): MuseumDraft {
  return { ...draft, exhibits: draft.exhibits.map((exhibit, i) => (i === index ? { ...exhibit, ...change } : exhibit)) };
}
export function withRoom(draft: MuseumDraft, index: number, change: Partial<RoomName>): MuseumDraft {
  return { ...draft, rooms: draft.rooms.map((room, i) => (i === index ? { ...room, ...change } : room)) };
}
/** Tours go on to name an exhibit that is called otherwise now. */
export function renamedExhibit(draft: MuseumDraft, index: number, id: string): MuseumDraft {
  const before = draft.exhibits[index].id;
  const tours = draft.tours.map((tour) => ({ ...tour, exhibits: tour.exhibits.map((one) => (one === before ? id : one)) }));
  return { ...withExhibit(draft, index, { id }), tours };
}
export function withTour(draft: MuseumDraft, index: number, change: Partial<Tour>): MuseumDraft {
  return { ...draft, tours: draft.tours.map((tour, i) => (i === index ? { ...tour, ...change } : tour)) };
}
export function withPose(draft: MuseumDraft, selection: Selection, pose: Pose): MuseumDraft {
  const next: Pose = [...at([pose[0], pose[1]]), pose[2]];
  if (selection.kind === 'home') return { ...draft, home: next };
  if (selection.kind === 'charger') return { ...draft, charger: next };
  return selection.kind === 'exhibit' ? withExhibit(draft, selection.index, { pose: next }) : draft;
}

/** A corner in the middle of a side becomes one of its own: it is `corner:INDEX+1` then. */
export function splitSide(draft: MuseumDraft, selection: Selection, index: number): MuseumDraft {
  const corners = cornersOf(draft, selection);
  if (!corners) return draft;
  const between = at(middle(corners[index], corners[(index + 1) % corners.length]));
  return withCorners(draft, selection, [...corners.slice(0, index + 1), between, ...corners.slice(index + 1)]);
}

export function moveHandle(draft: MuseumDraft, selection: Selection, handle: Pick<Handle, 'kind' | 'index'>, to: Point): MuseumDraft {
  const corners = cornersOf(draft, selection);
  if (corners)
    return handle.kind === 'corner' ? withCorners(draft, selection, corners.map((corner, i) => (i === handle.index ? at(to) : corner))) : draft;
  if (selection.kind === 'room') return withRoom(draft, selection.index, { at: at(to) });
  const pose = poseOf(draft, selection);
  if (!pose) return draft;
  if (handle.kind === 'pose') return withPose(draft, selection, [...to, pose[2]]);
  if (handle.kind === 'heading') return withPose(draft, selection, [pose[0], pose[1], towards(pose, to)]);
  if (selection.kind !== 'exhibit') return draft;
  const exhibit = draft.exhibits[selection.index];
  if (handle.kind === 'look') return withExhibit(draft, selection.index, { look_at: at(to) });
  // From a viewpoint the robot looks at the exhibit.
  const viewpoint: Pose = [...at(to), towards(to, exhibit.look_at)];
  return withExhibit(draft, selection.index, { viewpoints: exhibit.viewpoints.map((old, i) => (i === handle.index ? viewpoint : old)) });
}

/** All of what is selected, by so many metres. */
export function moveAll(draft: MuseumDraft, selection: Selection, by: Point): MuseumDraft {
  const corners = cornersOf(draft, selection);
  const moved = (point: Point): Point => at([point[0] + by[0], point[1] + by[1]]);
  if (corners) return withCorners(draft, selection, corners.map(moved));
  const room = roomOf(draft, selection);
  if (room && selection.kind === 'room') return withRoom(draft, selection.index, { at: moved(room.at) });
  const pose = poseOf(draft, selection);
  return pose ? withPose(draft, selection, [...moved([pose[0], pose[1]]), pose[2]]) : draft;
}

/** Without a corner or viewpoint; the same draft where it cannot be spared. */
export function removeHandle(draft: MuseumDraft, selection: Selection, handle: Pick<Handle, 'kind' | 'index'>): MuseumDraft {
  const corners = cornersOf(draft, selection);
  if (corners)
    return handle.kind === 'corner' && corners.length > LEAST_CORNERS ? withCorners(draft, selection, corners.filter((_, i) => i !== handle.index)) : draft;
  if (selection.kind !== 'exhibit' || handle.kind !== 'viewpoint') return draft;
  const { viewpoints } = draft.exhibits[selection.index];
  return withExhibit(draft, selection.index, { viewpoints: viewpoints.filter((_, i) => i !== handle.index) });
}

export function remove(draft: MuseumDraft, selection: Selection): MuseumDraft {
  switch (selection.kind) {
    case 'hazard':
      return { ...draft, hazards: draft.hazards.filter((_, i) => i !== selection.index) };
    case 'exhibit': {
      // Tours that led there lead past it; one that has no other stop goes, too.
      const { id } = draft.exhibits[selection.index];
      const tours = draft.tours
        .map((tour) => (tour.exhibits.includes(id) ? { ...tour, exhibits: tour.exhibits.filter((one) => one !== id) } : tour))
        .filter((tour) => tour.minutes !== null || tour.exhibits.length > 0);
      return { ...draft, exhibits: draft.exhibits.filter((_, i) => i !== selection.index), tours };
    }
    case 'tour':
      return { ...draft, tours: draft.tours.filter((_, i) => i !== selection.index) };
    case 'room':
      return { ...draft, rooms: draft.rooms.filter((_, i) => i !== selection.index) };
    case 'charger':
      return { ...draft, charger: null };
  }
  return draft;
}

/** `word-1`, or the first number that nobody has. */
export function freshId(taken: { id: string }[], word: string): string {
  const ids = new Set(taken.map(({ id }) => id));
  let number = 1;
  while (ids.has(`${word}-${number}`)) ++number;
  return `${word}-${number}`;
}

export function addHazard(draft: MuseumDraft, polygon: Point[]): MuseumDraft {
  const hazard: Hazard = { id: freshId(draft.hazards, 'hazard'), kind: 'other', polygon: polygon.map(at) };
  return { ...draft, hazards: [...draft.hazards, hazard] };
}
/** So many metres before the robot, which looks there. */
export const inFrontOf = (pose: Pose, metres: number): Pose => [pose[0] + metres * Math.cos(pose[2]), pose[1] + metres * Math.sin(pose[2]), pose[2]];

/** What stands a metre before the robot, which has been driven there to show it. */
export function addExhibitBefore(draft: MuseumDraft, robot: Pose, languages: string[], title: string): MuseumDraft {
  const [x, y] = inFrontOf(robot, 1);
  const next = addExhibit(draft, [x, y], languages, title);
  return withExhibit(next, next.exhibits.length - 1, { pose: [...at([robot[0], robot[1]]), robot[2]] });
}

/** The robot stands a metre before what it shows. */
export function addExhibit(draft: MuseumDraft, lookAt: Point, languages: string[], title: string): MuseumDraft {
  const [x, y] = at(lookAt);
  const texts = () => Object.fromEntries(languages.map((language) => [language, title]));
  const exhibit: Exhibit = {
    id: freshId(draft.exhibits, 'exhibit'),
    title: texts(),
    pose: [x, rounded(y - 1), Math.PI / 2],
    look_at: [x, y],
    viewpoints: [],
    short: texts(),
    long: {},
    topics: [],
    web_only: false,
    picture: '',
    links: [],
  };
  return { ...draft, exhibits: [...draft.exhibits, exhibit] };
}
/** A tour of a quarter of an hour, which the robot makes up as it goes: so it is whole without a stop. */
export function addTour(draft: MuseumDraft, languages: string[], title: string): MuseumDraft {
  const tour: Tour = { id: freshId(draft.tours, 'tour'), title: Object.fromEntries(languages.map((language) => [language, title])), exhibits: [], minutes: 15, daily: [] };
  return { ...draft, tours: [...draft.tours, tour] };
}
/** The name of a room, or of a part of one, where people say that they are there. */
export function addRoom(draft: MuseumDraft, place: Point, languages: string[], title: string): MuseumDraft {
  const room: RoomName = { id: freshId(draft.rooms, 'room'), name: Object.fromEntries(languages.map((language) => [language, title])), at: at(place) };
  return { ...draft, rooms: [...draft.rooms, room] };
}
/** "9-12, 13:30-18:00" → hours as museum.yaml has them, rising; null: one of them is none. */
export function hoursOf(text: string): string[] | null {
  const spans = text.split(/[,;]+/).map((one) => one.trim()).filter(Boolean).map((one) => {
    const parts = /^(\d{1,2})(?:[:.](\d{2}))?\s*[-–]\s*(\d{1,2})(?:[:.](\d{2}))?$/.exec(one);
    if (!parts) return null;
    const [from, to] = [[parts[1], parts[2]], [parts[3], parts[4]]].map(([hour, minute]) => ({ hour: +hour, minute: +(minute ?? 0) }));
    const isEnd = to.hour === 24 && to.minute === 0;
    if (from.hour > 23 || from.minute > 59 || to.minute > 59 || (to.hour > 23 && !isEnd)) return null;
    if (from.hour === to.hour && from.minute === to.minute) return null;
    const written = (time: { hour: number; minute: number }) => `${String(time.hour).padStart(2, '0')}:${String(time.minute).padStart(2, '0')}`;
    return `${written(from)}-${written(to)}`;
  });
  return spans.every((one) => one !== null) ? [...new Set(spans as string[])].sort() : null;
}
export const withHours = (draft: MuseumDraft, change: Partial<OpeningHours>): MuseumDraft => ({ ...draft, hours: { ...draft.hours, ...change } });
/** With these stops; without any it is made up as it goes. */
export const stopsOf = (exhibits: string[]): Pick<Tour, 'exhibits' | 'minutes'> => ({ exhibits, minutes: exhibits.length > 0 ? null : 15 });
/** "9:05, 14:00" → times of the day, rising; null: one of them is none. */
export function timesOf(text: string): string[] | null {
  const times = text.split(/[,;\s]+/).filter(Boolean).map((one) => {
    const parts = /^(\d{1,2})[:.](\d{2})$/.exec(one);
    return parts && +parts[1] < 24 && +parts[2] < 60 ? `${parts[1].padStart(2, '0')}:${parts[2]}` : null;
  });
  return times.every((one) => one !== null) ? [...new Set(times as string[])].sort() : null;
}
export function addViewpoint(draft: MuseumDraft, index: number, place: Point): MuseumDraft {
  const { viewpoints, look_at } = draft.exhibits[index];
  return withExhibit(draft, index, { viewpoints: [...viewpoints, [...at(place), towards(place, look_at)]] });
}

/** Whether two sides cross: no robot understands such a polygon. */
export function crossesItself(corners: Point[]): boolean {
  const side = (a: Point, b: Point, c: Point) => Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  const count = corners.length;
  for (let i = 0; i < count; ++i)
    for (let k = i + 2; k < count; ++k) {
      if ((k + 1) % count === i) continue;
      const [a, b, c, d] = [corners[i], corners[i + 1], corners[k], corners[(k + 1) % count]];
      if (side(a, b, c) !== side(a, b, d) && side(c, d, a) !== side(c, d, b)) return true;
    }
  return false;
}
