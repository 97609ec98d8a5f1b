import { expect, test } from 'vitest';
import type { StatisticsDay } from '../lib/protocol';
import { COUNTS, csvOf } from './counts';

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
