// Whose turn it is when: the place of a wish among those that wait, and about how long it takes until then. The robot takes
// what lies on its way first, so that the order is that of its agenda and not that of the wishes.
import type { BoardEntry, MissionMessage, Museum, PathMessage } from './protocol';
import { PACE, minutesOf, spokenLength, wayBetween } from './tour';

export interface Turn {
  /** 1: it is next. */
  place: number;
  /** [min] until the robot begins with it. */
  minutes: number;
}
/** What the robot says that the reckoning needs. */
export interface Plans {
  open: BoardEntry[];
  mission: MissionMessage | null;
  path: PathMessage | null;
}

/** The turn of an exhibit or a tour that waits. Null: it does not wait, or nobody can say. */
export function turnOf(kind: string, target: string, { open, mission, path }: Plans, museum: Museum | null, language: string): Turn | null {
  if (!mission || !museum) return null;
  const waits = (of: string, what: string) => open.some((entry) => entry.kind === of && entry.target === what && entry.state === 'queued');
  if (!waits(kind, target)) return null;
  const exhibitOf = (id: string) => museum.exhibits.find((one) => one.id === id);
  // At the end of the agenda stand the tours that wait, each with all its stops.
  const tours = [...new Set(open.filter((entry) => entry.kind === 'tour' && entry.state === 'queued').map((entry) => entry.target))];
  const stopsOfTours = tours.reduce((sum, id) => sum + (museum.tours.find((one) => one.id === id)?.exhibits.length ?? 0), 0);
  const stops = mission.agenda.slice(0, Math.max(0, mission.agenda.length - stopsOfTours));
  const singles = stops.filter((id) => waits('exhibit', id));
  const place = (kind === 'tour' ? singles.length + tours.indexOf(target) : singles.indexOf(target)) + 1;
  if (place === 0) return null;

  let at = exhibitOf(mission.exhibit);
  const isThere = mission.phase === 'explaining' || mission.phase === 'asking';
  let seconds = at && isThere ? spokenLength(at, language) / 2 : 0;
  if (at && mission.phase === 'driving') seconds = (path?.remaining ?? 0) / PACE + spokenLength(at, language);
  for (const id of stops) {
    const next = exhibitOf(id);
    if (!next) continue;
    if (at) seconds += wayBetween(at, next) / PACE;
    if (kind === 'exhibit' && id === target) break;
    seconds += spokenLength(next, language);
    at = next;
  }
  if (kind === 'tour') {
    for (const id of tours.slice(0, tours.indexOf(target))) {
      const tour = museum.tours.find((one) => one.id === id);
      seconds += 60 * ((tour && minutesOf(tour, museum, language)) ?? 5);
    }
  }
  return { place, minutes: Math.max(1, Math.round(seconds / 60)) };
}

/** "1st", "2.", "3e". */
export function ordinal(language: string, n: number): string {
  if (language === 'de') return `${n}.`;
  if (language === 'fr') return n === 1 ? '1er' : `${n}e`;
  const endings: Record<string, string> = { one: 'st', two: 'nd', few: 'rd' };
  return `${n}${endings[new Intl.PluralRules('en', { type: 'ordinal' }).select(n)] ?? 'th'}`;
}
