import { expect, test } from 'vitest';
import type { StatisticsDay, TourStopCount } from '../lib/protocol';
import { attendanceCsvOf, COUNTS, countOf, csvOf, POLL, toursOf } from './counts';

const days: StatisticsDay[] = [
  { day: '2026-11-29', mode: 'open', web_visitors: 3, counts: { fulfilled: 8, failed: 2, distance_m: 500, travel_s: 1000, max_speed: 0.7, uptime_s: 7200, web: 4, kiosk: 6 } },
  { day: '2026-11-29', mode: 'web', web_visitors: 5, counts: { fulfilled: 9, failed: 1, distance_m: 300, travel_s: 1000, max_speed: 0.4, uptime_s: 3600, web: 10 } },
];
const of = (key: string, some = days) => COUNTS.find((count) => count.key === key)!.of(some);

test('shares and means are of all days together, and not means of means', () => {
  expect(of('success')).toBeCloseTo(85);
  expect(of('mean_speed')).toBeCloseTo(0.4);
  expect(of('max_speed')).toBe(0.7);
  expect(of('requests')).toBe(20);
  expect(of('exclusive')).toBe(1);
});
test('what was never tried has no rate', () => {
  expect(of('success', [])).toBeNull();
  expect(of('mean_speed', [])).toBeNull();
  expect(of('max_speed', [])).toBeNull();
});
test('as a table: a line for each day and mode', () => {
  const [head, open, web, end] = csvOf(days).split('\n');
  const value = (line: string, key: string) => line.split(',')[head.split(',').indexOf(key)];
  expect(head.startsWith('day,mode,web_visitors')).toBe(true);
  expect([value(open, 'day'), value(open, 'mode'), value(open, 'success'), value(open, 'mean_speed')]).toEqual(['2026-11-29', 'open', '80', '0.50']);
  expect([value(web, 'mode'), value(web, 'distance'), value(web, 'exclusive')]).toEqual(['web', '0.30', '1.0']);
  expect(end).toBe('');
});

test('all four questions of the poll are counted by answer, and are columns of the table', () => {
  const answered: StatisticsDay = { day: '2026-11-29', mode: 'open', web_visitors: 0, counts: { liked_yes: 3, price_no: 2, amoeba: 1 } };
  expect(POLL.map(({ question }) => question)).toEqual(['liked', 'satisfied', 'price', 'intelligence']);
  expect([countOf('liked_yes'), countOf('price_no'), countOf('intelligence_amoeba'), countOf('satisfied_no')].map((one) => one.of([answered]))).toEqual([3, 2, 1, 0]);
  const [head, line] = csvOf([answered]).split('\n');
  expect(line.split(',')[head.split(',').indexOf('price_no')]).toBe('2');
  expect(line.split(',').length).toBe(head.split(',').length);
});
test('a tour is told from the next by when it began, and its stops say who has left', () => {
  const stop = (began: number, number: number, people: number): TourStopCount => ({
    day: '2026-11-29', mode: 'open', tour_began: began, tour: 'highlights', stop: number, exhibit: `e${number}`, people,
  });
  const attendance = [stop(60, 2, 4), stop(60, 1, 6), stop(3660, 1, 2), stop(60, 3, 5)];
  expect(toursOf(attendance).map(({ began, stops }) => [began, ...stops.map(({ people }) => people)])).toEqual([[3660, 2], [60, 6, 4, 5]]);
  expect(attendanceCsvOf(attendance).split('\n').slice(0, 4)).toEqual([
    'day,mode,began,tour,stop,exhibit,people,left',
    '2026-11-29,open,1970-01-01T00:01:00Z,highlights,1,e1,6,0',
    '2026-11-29,open,1970-01-01T00:01:00Z,highlights,2,e2,4,2',
    '2026-11-29,open,1970-01-01T00:01:00Z,highlights,3,e3,5,0',
  ]);
});
