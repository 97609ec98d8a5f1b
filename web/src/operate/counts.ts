// What the days come to, as the papers count them, and as a table for other programs.
import type { StatisticsDay, TourStopCount } from '../lib/protocol';

export type CountKey =
  | 'web_visitors' | 'accesses' | 'visitors' | 'requests' | 'fulfilled' | 'failed' | 'success' | 'votes' | 'tours' | 'tours_failed' | 'tours_broken'
  | 'revisions' | 'first_stop' | 'last_stop' | 'exhibits' | 'points' | 'contacts' | 'distance' | 'uptime' | 'exclusive' | 'travel' | 'mean_speed' | 'max_speed'
  | PollKey;
/** An answer to a question of the poll. */
export type PollKey = `${'liked' | 'satisfied' | 'price'}_${'yes' | 'undecided' | 'no'}` | `intelligence_${'human' | 'monkey' | 'dog' | 'fish' | 'amoeba'}`;
export interface Count {
  key: CountKey;
  /** Behind the point. */
  places: number;
  /** Of some days, or modes of a day; null: nothing of it was counted. */
  of: (days: StatisticsDay[]) => number | null;
}

const SOURCES = ['web', 'kiosk', 'visitor', 'staff', 'vote'];
const one = (what: string) => (day: StatisticsDay) => day.counts[what] ?? 0;
const sum = (value: (day: StatisticsDay) => number) => (days: StatisticsDay[]) => days.reduce((all, day) => all + value(day), 0);
const share = (part: (days: StatisticsDay[]) => number, whole: (days: StatisticsDay[]) => number) => (days: StatisticsDay[]) => {
  const all = whole(days);
  return all > 0 ? part(days) / all : null;
};
const count = (key: CountKey, what: string, factor = 1, places = 0): Count => ({ key, places, of: sum((day) => one(what)(day) * factor) });

export const COUNTS: Count[] = [
  { key: 'web_visitors', places: 0, of: sum((day) => day.web_visitors) },
  count('accesses', 'accesses'),
  count('visitors', 'visitors'),
  { key: 'requests', places: 0, of: sum((day) => SOURCES.reduce((all, source) => all + one(source)(day), 0)) },
  count('fulfilled', 'fulfilled'),
  count('failed', 'failed'),
  { key: 'success', places: 0, of: (days) => share(sum((day) => 100 * one('fulfilled')(day)), sum((day) => one('fulfilled')(day) + one('failed')(day)))(days) },
  count('votes', 'votes'),
  count('tours', 'tours'),
  count('tours_failed', 'tours_failed'),
  count('tours_broken', 'tours_broken'),
  count('revisions', 'plan_revisions'),
  count('first_stop', 'first_stop'),
  count('last_stop', 'last_stop'),
  count('exhibits', 'exhibits'),
  count('points', 'points'),
  count('contacts', 'contacts'),
  count('distance', 'distance_m', 1 / 1000, 2),
  count('uptime', 'uptime_s', 1 / 3600, 1),
  { key: 'exclusive', places: 1, of: sum((day) => (day.mode === 'web' ? one('uptime_s')(day) / 3600 : 0)) },
  count('travel', 'travel_s', 1 / 3600, 1),
  { key: 'mean_speed', places: 2, of: share(sum(one('distance_m')), sum(one('travel_s'))) },
  { key: 'max_speed', places: 2, of: (days) => (days.length > 0 ? Math.max(...days.map(one('max_speed'))) : null) },
];

const OPINIONS = ['yes', 'undecided', 'no'] as const;
const MINDS = ['human', 'monkey', 'dog', 'fish', 'amoeba'] as const;
/** The questions of the poll with how often each answer was given ([Minerva2000] 7). */
export const POLL = [
  ...(['liked', 'satisfied', 'price'] as const).map((question) => ({
    question, answers: OPINIONS.map((answer) => ({ answer, count: count(`${question}_${answer}`, `${question}_${answer}`) })),
  })),
  { question: 'intelligence' as const, answers: MINDS.map((answer) => ({ answer, count: count(`intelligence_${answer}`, answer) })) },
];
const ALL = [...COUNTS, ...POLL.flatMap(({ answers }) => answers.map(({ count }) => count))];
export const countOf = (key: CountKey): Count => ALL.find((one) => one.key === key)!;

/** A tour that was given, with the people at each of its stops: who left, and when. */
export interface TourFollowed {
  began: number;
  tour: string;
  mode: string;
  stops: TourStopCount[];
}
/** The newest first. */
export function toursOf(attendance: TourStopCount[]): TourFollowed[] {
  const tours = new Map<number, TourFollowed>();
  for (const stop of attendance) {
    const tour = tours.get(stop.tour_began) ?? { began: stop.tour_began, tour: stop.tour, mode: stop.mode, stops: [] };
    tour.stops.push(stop);
    tours.set(stop.tour_began, tour);
  }
  for (const tour of tours.values()) tour.stops.sort((a, b) => a.stop - b.stop);
  return [...tours.values()].sort((a, b) => b.began - a.began);
}
/** A line for each stop of a tour; `left`: how many fewer than at the stop before. */
export function attendanceCsvOf(attendance: TourStopCount[]): string {
  const lines = [['day', 'mode', 'began', 'tour', 'stop', 'exhibit', 'people', 'left']];
  for (const { began, tour, stops } of toursOf(attendance).reverse()) {
    stops.forEach((stop, i) => {
      const left = i === 0 ? 0 : Math.max(0, stops[i - 1].people - stop.people);
      lines.push([stop.day, stop.mode, new Date(1000 * began).toISOString().slice(0, 19) + 'Z', tour, `${stop.stop}`, stop.exhibit, `${stop.people}`, `${left}`]);
    });
  }
  return lines.map((line) => line.join(',')).join('\n') + '\n';
}

/** A line for each day and mode, with a head; numbers have a point. */
export function csvOf(days: StatisticsDay[]): string {
  const head = ['day', 'mode', ...ALL.map(({ key }) => key)];
  const lines = days.map((day) => [day.day, day.mode, ...ALL.map(({ of, places }) => of([day])?.toFixed(places) ?? '')]);
  return [head, ...lines].map((line) => line.join(',')).join('\n') + '\n';
}
