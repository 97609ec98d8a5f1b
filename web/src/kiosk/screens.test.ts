import { describe, expect, test } from 'vitest';
import type { MissionMessage, Museum } from '../lib/protocol';
import { type Choice, litOf, type Situation, screenOf } from './screens';
import { kioskLanguages, kioskWord, nameOf } from './words';

const exhibit = (id: string, long: string) => ({
  id, title: { en: `The ${id}`, de: `Das ${id}`, fr: `Le ${id}` }, pose: [0, 0, 0] as [number, number, number], look_at: [1, 0] as [number, number],
  viewpoints: [], short: { en: 'short' }, long: (long ? { en: long } : {}) as Record<string, string>, topics: [], web_only: false, picture: '', links: [],
});
const tour = (id: string) => ({ id, title: { en: `Tour ${id}` }, exhibits: ['clock', 'coin'], minutes: null, daily: [] });
const museum = (languages: string[], tours: string[]): Museum => ({
  name: { en: 'A hall' }, languages, area: [], home: [0, 0, 0], charger: null, robot_radius: 0.3,
  map: { url: '', columns: 1, rows: 1, resolution: 1, origin: [0, 0] }, hazards: [],
  exhibits: [exhibit('clock', 'a long story'), exhibit('coin', '')], tours: tours.map(tour), rooms: [], doors: [],
});
const mission = (phase: string, more: Partial<MissionMessage> = {}): MissionMessage => ({
  type: 'mission', phase, tour: '', exhibit: 'clock', text: {}, agenda: [], explained: 0, tours: 0, served: 0, prompt: null, ...more,
});
const asksMore = { id: 't/more', text: { en: 'More?', de: 'Mehr?' }, language: 'de', options: ['more', 'next'], default: 'next', deadline: 5 };
const base: Situation = {
  language: 'en', museum: museum(['en', 'de', 'fr'], ['a', 'b', 'c', 'd', 'e']), isOwn: true, line: 'open', localized: true, mission: mission('idle'),
  speech: null, sentence: '', blocked: false, left: 0, answered: false, asked: null, poll: null, page: 'home', from: 0, smaller: false,
};
const at = (change: Partial<Situation>) => screenOf({ ...base, ...change });
const labels = (choices: (Choice | null)[]) => choices.map((choice) => choice?.label ?? null);

describe('at home', () => {
  test('four buttons: a tour, the others, help, languages', () => {
    const screen = at({});
    expect(screen.name).toBe('home');
    expect(labels(screen.choices)).toEqual(['Tour a', 'Other tours', 'How does it work?', 'Language']);
    expect(screen.choices[0]?.about).toBe('2 stops');
    expect(screen.choices[3]?.about).toBe('Deutsch · Français');
    expect(litOf(screen)).toEqual([1, 2, 3, 4]);
  });
  test('two tours need no list, and a second language no page', () => {
    const screen = at({ museum: museum(['en', 'de'], ['a', 'b']) });
    expect(labels(screen.choices)).toEqual(['Tour a', 'Tour b', 'How does it work?', 'Deutsch']);
    expect(screen.choices[3]).toMatchObject({ language: 'de', act: { do: 'language', code: 'de' } });
    expect(at({ museum: museum(['en'], ['a']) }).choices[3]).toBeNull();
    expect(litOf(at({ museum: museum(['en'], []) }))).toEqual([3]);
  });
  test('it says why nothing starts yet', () => {
    for (const phase of ['going_home', 'charging', 'waiting']) {
      expect(at({ mission: mission(phase) }).name).toBe('home');
      expect(at({ mission: mission(phase) }).text).not.toBe(at({}).text);
    }
  });
  test('every tour can be reached by the third button, and the fourth always leads back', () => {
    const seen = new Set<string>();
    let from = 0;
    for (let press = 0; press < 3; ++press) {
      const screen = at({ page: 'tours', from });
      for (const choice of screen.choices) if (choice?.act.do === 'tour') seen.add(choice.act.id);
      expect(screen.choices[3]).toMatchObject({ label: 'Back', act: { do: 'page', page: 'home' } });
      const on = screen.choices[2]!.act;
      if (on.do !== 'page') throw new Error('the third button leads nowhere');
      from = on.from!;
    }
    expect([...seen].sort()).toEqual(['a', 'b', 'c', 'd', 'e']);
    expect(from).toBe(0);
    expect(labels(at({ page: 'tours', museum: museum(['en'], ['a', 'b', 'c']) }).choices)).toEqual(['Tour a', 'Tour b', 'Tour c', 'Back']);
  });
  test('as many languages as the museum has, each by its own name', () => {
    const screen = at({ page: 'languages', museum: museum(['en', 'de', 'fr', 'nl', 'it'], ['a']) });
    expect(labels(screen.choices)).toEqual(['English', 'Deutsch', 'Language …', 'Back']);
    expect(labels(at({ page: 'languages', from: 4, museum: museum(['en', 'de', 'fr', 'nl', 'it'], ['a']) }).choices)).toEqual(['Italiano', null, 'Language …', 'Back']);
  });
});

describe('a tour', () => {
  test('from the wish to the way there', () => {
    expect(at({ asked: { state: 'sending', reason: null, age: 0, since: 0 } }).name).toBe('sending');
    expect(at({ asked: { state: 'queued', reason: null, age: 1, since: 1 } }).name).toBe('coming');
    const later = at({ asked: { state: 'queued', reason: null, age: 60, since: 60 }, mission: mission('charging') });
    expect(later.name).toBe('home');
    expect(later.text).toContain('on my list');
    expect(at({ asked: { state: 'refused', reason: null, age: 2, since: 2 } }).name).toBe('refused');
    const closed = at({ language: 'de', asked: { state: 'refused', reason: { word: 'closed', about: '' }, age: 2, since: 2 } });
    expect([closed.title, closed.text]).toEqual([kioskWord('de', 'refused'), 'Das Museum ist geschlossen.']);
    const missed = at({ asked: { state: 'failed', reason: { word: 'not_reached', about: 'clock gone' }, age: 2, since: 2 } });
    expect(missed.text).toBe('I could not get to: The clock, gone.');
    expect(at({ asked: { state: 'refused', reason: null, age: 60, since: 60 } }).name).toBe('home');
  });
  test('on the way it shows where to; others may ask for a tour, too', () => {
    const own = at({ mission: mission('driving'), asked: { state: 'active', reason: null, age: 30, since: 20 } });
    expect([own.name, own.title, own.exhibit, litOf(own).join()]).toEqual(['driving', 'The clock', 'clock', '1,4']);
    expect(litOf(at({ mission: mission('driving') }))).toEqual([1, 4]);
    expect(at({ mission: mission('driving'), page: 'tours' }).name).toBe('tours');
    const blocked = at({ mission: mission('driving'), blocked: true });
    expect([blocked.name, blocked.text]).toEqual(['blocked', 'Excuse me, may I pass?']);
  });
  test('"more" is announced while the first words are spoken, and is not lit yet', () => {
    const screen = at({ mission: mission('explaining'), sentence: 'It ticks.' });
    expect([screen.name, screen.text]).toEqual(['explaining', 'It ticks.']);
    expect(labels(screen.choices)).toEqual([null, null, 'Tell me more', 'Go on']);
    expect(litOf(screen)).toEqual([]);
    const speech = { type: 'speech' as const, id: 't/long', state: 'speaking', text: '', language: 'en', start: 0, duration: 1, audio: '' };
    expect(at({ mission: mission('explaining'), speech }).choices).toEqual([null, null, null, null]);
    expect(at({ mission: mission('explaining', { exhibit: 'coin' }) }).choices).toEqual([null, null, null, null]);
  });
  test('green is more, blue is on; red is no, green is yes', () => {
    const screen = at({ mission: mission('asking', { prompt: asksMore }), left: 4 });
    expect(labels(screen.choices)).toEqual([null, null, 'Tell me more', 'Go on']);
    expect(screen.title).toBe('Would you like to hear more?');
    expect(litOf(screen)).toEqual([3, 4]);
    const yes = at({ mission: mission('asking', { prompt: { ...asksMore, text: { en: 'Shall we?', de: 'Sollen wir?' }, options: ['yes', 'no'] } }), left: 4 });
    expect([yes.title, ...labels(yes.choices)]).toEqual(['Shall we?', 'No', null, 'Yes', null]);
    const other = at({ mission: mission('asking', { prompt: { ...asksMore, options: ['left', 'right', 'yes', 'a', 'b'] } }), left: 4 });
    expect(labels(other.choices)).toEqual(['left', 'right', 'Yes', 'a']);
  });
  test('an answer is acknowledged, and a question whose time is over is none', () => {
    const asks = mission('asking', { prompt: asksMore });
    expect(at({ mission: asks, left: 3, answered: true }).name).toBe('answered');
    expect(at({ mission: asks, left: 0 }).name).toBe('explaining');
  });
});

describe('on the way', () => {
  test('says which stop of how many this is, and what comes next', () => {
    const on = (phase: string, agenda: string[]) => at({ mission: mission(phase, { tour: 'a', agenda }) }).progress;
    expect(on('driving', ['coin'])).toBe('stop 1 of 2 · then: The coin');
    expect(on('explaining', [])).toBe('stop 2 of 2 · the last one');
    expect(at({ mission: mission('driving') }).progress).toBeUndefined();
  });
  test('those who wished for it end it, when they say so twice', () => {
    const own = { mission: mission('driving'), asked: { state: 'active', reason: null, age: 30, since: 20 } };
    expect(at(own).choices[0]).toMatchObject({ label: 'End the tour', act: { do: 'page', page: 'end' } });
    const ending = at({ ...own, page: 'end' });
    expect([ending.name, ...labels(ending.choices)]).toEqual(['ending', 'No', null, 'Yes', null]);
    expect(ending.choices[2]?.act).toEqual({ do: 'end' });
    expect(at({ mission: mission('driving'), page: 'end' }).name).toBe('driving');
  });
});

describe('a stop that nobody wants', () => {
  const asked = { state: 'active', reason: null, age: 30, since: 20 };
  const skip = (change: Partial<Situation>) => at(change).choices[1]?.act;
  test('is skipped on the way there and while it is explained', () => {
    for (const phase of ['driving', 'explaining']) {
      for (const exhibit of ['clock', 'coin']) {
        const screen = at({ mission: mission(phase, { tour: 'a', exhibit }), asked });
        expect(screen.choices[1]).toEqual({ label: 'Skip this stop', act: { do: 'skipStop', exhibit } });
        expect(litOf(screen)).toContain(2);
      }
    }
    expect(skip({ mission: mission('driving', { tour: 'a' }), asked, blocked: true })).toBeDefined();
  });
  test('by those who wished for the tour here alone, and only where it is a stop of it', () => {
    expect(skip({ mission: mission('driving', { tour: 'a' }) })).toBeUndefined();
    expect(skip({ mission: mission('driving'), asked })).toBeUndefined();
    expect(skip({ mission: mission('driving', { tour: 'a', exhibit: 'elsewhere' }), asked })).toBeUndefined();
    const composed = { ...base.museum!, tours: [{ ...tour('a'), exhibits: [], minutes: 6 }] };
    expect(skip({ museum: composed, mission: mission('driving', { tour: 'a' }), asked })).toEqual({ do: 'skipStop', exhibit: 'clock' });
  });
});

describe('the questions at the end', () => {
  test('every answer of Minerva’s poll has a button', () => {
    const answers = (change: Partial<Situation>) => at({ poll: 0, ...change }).choices.flatMap((choice) => (choice?.act.do === 'poll' ? [choice.act.answer] : []));
    expect(answers({ poll: 0 })).toEqual(['no', 'undecided', 'yes']);
    expect(answers({ poll: 1 })).toEqual(['no', 'undecided', 'yes']);
    expect(answers({ poll: 2 })).toEqual(['no', 'undecided', 'yes']);
    expect([...answers({ poll: 3 }), ...answers({ poll: 3, smaller: true })]).toEqual(['human', 'monkey', 'dog', 'fish', 'amoeba']);
    expect(at({ poll: 4 }).name).toBe('thanks');
  });
  test('a tour that begins is more important', () => {
    expect(at({ poll: 1, mission: mission('driving') }).name).toBe('driving');
    expect(at({ poll: 1, mission: mission('going_home') }).name).toBe('poll');
  });
});

describe('when something is wrong', () => {
  test('no line, no pose, no key', () => {
    expect(at({ line: 'lost' }).name).toBe('away');
    expect(at({ line: 'connecting' }).name).toBe('opening');
    expect(at({ mission: null }).name).toBe('opening');
    expect(at({ localized: false }).name).toBe('lost');
    expect(at({ mission: mission('waking') }).name).toBe('lost');
    expect(at({ isOwn: false, line: 'lost' }).name).toBe('stranger');
    for (const change of [{ line: 'lost' as const }, { localized: false }, { isOwn: false }]) expect(litOf(at(change))).toEqual([]);
  });
});

test('every dictionary is whole, and another language gets English words', () => {
  expect(kioskLanguages.sort()).toEqual(['de', 'en', 'fr']);
  expect(kioskWord('fr', 'yes')).toBe('Oui');
  expect(kioskWord('nl', 'yes')).toBe('Yes');
  expect(nameOf('fr')).toBe('Français');
});
