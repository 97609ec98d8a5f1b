import { describe, expect, it } from 'vitest';
import type { BoardEntry, Exhibit, MissionMessage, Museum } from './protocol';
import { ordinal, turnOf } from './queue';
import { minutesOf, progressOf } from './tour';

const exhibit = (id: string, x: number) => ({ id, pose: [x, 0, 0], short: { en: 'x'.repeat(280) }, title: { en: id } }) as unknown as Exhibit;
const museum = {
  languages: ['en'],
  exhibits: ['a', 'b', 'c', 'd'].map((id, i) => exhibit(id, 10 * i)),
  tours: [{ id: 'all', title: { en: 'All' }, exhibits: ['a', 'b', 'c'], minutes: null }, { id: 'six', title: { en: 'Six' }, exhibits: [], minutes: 6 }],
} as unknown as Museum;
const mission = (more: Partial<MissionMessage>) =>
  ({ type: 'mission', phase: 'explaining', tour: '', exhibit: 'a', text: {}, agenda: [], explained: 0, tours: 0, served: 0, prompt: null, ...more }) as MissionMessage;
const waiting = (kind: string, target: string, state = 'queued') => ({ key: `${kind}${target}`, kind, target, state, created: 0 }) as unknown as BoardEntry;

describe('the turn of a wish', () => {
  const open = [waiting('exhibit', 'c'), waiting('exhibit', 'b'), waiting('tour', 'six'), waiting('tour', 'all')];
  const plans = { open, mission: mission({ agenda: ['b', 'c', 'a', 'b', 'c'] }), path: null };
  it('is that of the agenda, and not that of the wishes', () => {
    expect(turnOf('exhibit', 'b', plans, museum, 'en')?.place).toBe(1);
    expect(turnOf('exhibit', 'c', plans, museum, 'en')?.place).toBe(2);
  });
  it('of a tour comes behind all exhibits and the tours before it', () => {
    const six = turnOf('tour', 'six', plans, museum, 'en')!;
    const all = turnOf('tour', 'all', plans, museum, 'en')!;
    expect(six.place).toBe(3);
    expect(all).toEqual({ place: 4, minutes: six.minutes + 6 });
  });
  it('takes the ways and the words until then', () => {
    // Half a story at a (14 s), 13 m to b (32.5 s), its story (28 s), 13 m to c.
    expect(turnOf('exhibit', 'c', plans, museum, 'en')?.minutes).toBe(2);
  });
  it('is not told of what is under way, or is not wished for', () => {
    expect(turnOf('exhibit', 'a', { ...plans, open: [waiting('exhibit', 'a', 'active')] }, museum, 'en')).toBeNull();
    expect(turnOf('exhibit', 'd', plans, museum, 'en')).toBeNull();
    expect(turnOf('exhibit', 'b', { ...plans, mission: null }, museum, 'en')).toBeNull();
  });
});

describe('a tour', () => {
  it('says which stop of how many this is, and what comes', () => {
    expect(progressOf(mission({ tour: 'all', exhibit: 'b', agenda: ['c', 'd'] }), museum)).toEqual({ stop: 2, stops: 3, next: ['c'] });
    expect(progressOf(mission({ tour: 'all', exhibit: 'c', agenda: ['a', 'b', 'c'] }), museum)?.stop).toBe(1);
    expect(progressOf(mission({ tour: 'all', exhibit: 'c', agenda: ['d'] }), museum)).toEqual({ stop: 3, stops: 3, next: [] });
  });
  it('has no stops to count where it is made up on the way', () => {
    expect(progressOf(mission({ tour: 'six', exhibit: 'a' }), museum)).toBeNull();
    expect(progressOf(mission({}), museum)).toBeNull();
  });
  it('takes as long as its words and ways', () => {
    expect(minutesOf(museum.tours[0], museum, 'en')).toBe(2);
    expect(minutesOf(museum.tours[1], museum, 'en')).toBe(6);
  });
});

it('numbers are said as the language says them', () => {
  expect([1, 2, 3, 4, 11, 21].map((n) => ordinal('en', n))).toEqual(['1st', '2nd', '3rd', '4th', '11th', '21st']);
  expect(ordinal('de', 2)).toBe('2.');
  expect([1, 2].map((n) => ordinal('fr', n))).toEqual(['1er', '2e']);
});
