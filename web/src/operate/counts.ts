// What the days come to, as the papers count them, and as a table for other programs.
import type { StatisticsDay } from '../lib/protocol';

export type CountKey =
  | 'web_visitors' | 'accesses' | 'visitors' | 'requests' | 'fulfilled' | 'failed' | 'success' | 'votes' | 'tours' | 'tours_failed' | 'tours_broken'
  | 'revisions' | 'first_stop' | 'last_stop' | 'exhibits' | 'points' | 'distance' | 'uptime' | 'exclusive' | 'travel' | 'mean_speed' | 'max_speed';
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
  count('distance', 'distance_m', 1 / 1000, 2),
  count('uptime', 'uptime_s', 1 / 3600, 1),
  { key: 'exclusive', places: 1, of: sum((day) => (day.mode === 'web' ? one('uptime_s')(day) / 3600 : 0)) },
  count('travel', 'travel_s', 1 / 3600, 1),
  { key: 'mean_speed', places: 2, of: share(sum(one('distance_m')), sum(one('travel_s'))) },
  { key: 'max_speed', places: 2, of: (days) => (days.length > 0 ? Math.max(...days.map(one('max_speed'))) : null) },
];

/** A line for each day and mode, with a head; numbers have a point. */
export function csvOf(days: StatisticsDay[]): string {
  const head = ['day', 'mode', ...COUNTS.map(({ key }) => key)];
  const lines = days.map((day) => [day.day, day.mode, ...COUNTS.map(({ of, places }) => of([day])?.toFixed(places) ?? '')]);
  return [head, ...lines].map((line) => line.join(',')).join('\n') + '\n';
}
