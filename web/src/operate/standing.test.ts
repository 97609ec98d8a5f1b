import { expect, test } from 'vitest';
import { type Seen, standingOf } from './standing';

const operation = { type: 'operation' as const, holder: '', pressed: false, stopped: false, stopped_by: '', stop_number: 0, hours: '' };
const mission = (phase: string, exhibit = '') =>
  ({ type: 'mission' as const, phase, tour: '', exhibit, text: {}, agenda: [], explained: 0, tours: 0, served: 0, prompt: null }) as Seen['mission'];
const avoid = { state: '', reason: { word: 'person_in_way' as const, about: '' }, cap: 0, blocked: true, person: true, real: null, virtual: null };
const health = (...modules: [string, string][]) => ({ type: 'health' as const, viewers: 1, modules: modules.map(([name, state]) => ({ name, state, reason: '', p99_ms: null })) });
const hours = (mode: string) => ({ type: 'hours' as const, mode, is_open: true, next_mode: '', next_at: '' });
const well: Seen = {
  isOpen: true, operation, mission: mission('driving', 'zuse'), hours: hours('open'), health: health(['avoid', 'ready']), avoid: null,
  localized: true, isMoving: true, battery: 0.8,
};
const why = (more: Partial<Seen>) => standingOf({ ...well, ...more });

test('what stops it comes before all that it is at', () => {
  expect(why({ isOpen: false, operation: { ...operation, stopped: true } })).toMatchObject({ why: 'noLine', mood: 'bad' });
  expect(why({ operation: { ...operation, stopped: true, stopped_by: 'ada' }, avoid })).toMatchObject({ why: 'stopped', about: 'ada', mood: 'bad' });
  expect(why({ health: health(['avoid', 'silent'], ['web', 'ready']), localized: false })).toMatchObject({ why: 'broken', about: 'avoid' });
  expect(why({ health: health(['record', 'faulted']) })).toMatchObject({ why: 'driving' });
});
test('a robot on its way that stands says what is in its way', () => {
  expect(why({ isMoving: false, avoid })).toMatchObject({ why: 'held', about: 'zuse', reason: { word: 'person_in_way' }, mood: 'held' });
  expect(why({ isMoving: true, avoid })).toMatchObject({ why: 'driving', mood: 'well' });
});
test('what it waits for', () => {
  expect(why({ localized: false })).toMatchObject({ why: 'lost' });
  expect(why({ operation: { ...operation, holder: 'grace' } })).toMatchObject({ why: 'steered', about: 'grace' });
  expect(why({ mission: mission('charging') })).toMatchObject({ why: 'charging' });
  expect(why({ mission: mission('explaining', 'zuse') })).toMatchObject({ why: 'telling', about: 'zuse' });
  expect(why({ mission: mission('idle') })).toMatchObject({ why: 'idle' });
  expect(why({ mission: mission('idle'), hours: hours('closed') })).toMatchObject({ why: 'closed' });
  expect(why({ mission: mission('idle'), hours: hours('web') })).toMatchObject({ why: 'webHours' });
});
