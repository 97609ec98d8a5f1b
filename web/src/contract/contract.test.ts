import { expect, test } from 'vitest';
import clientText from '../../../tests/web_contract/client.json?raw';
import { Motion } from '../lib/motion';
import { answerOf, cancelOf, choiceOf, helpOf, lampsOf, leaseOf, requestOf, setHoursOf, skipOf, steerOf, stopOf, voteOf, watchOf } from '../lib/orders';
import { decode, type LiveMessage, type Reason } from '../lib/protocol';
import { pageLanguage, pageLanguages, phaseWord, reasonText, word } from '../lib/words';
import { kioskLanguages } from '../kiosk/words';
import { documents } from './contract';

// The server's half of this test is src/docent/telepresence/contract/contract_test.cpp.

type Shape = string | { [kind: string]: unknown };
interface Table {
  [name: string]: { type?: string; fields: Record<string, Shape>; maybe: Record<string, Shape> };
}
const table: Table = documents;
const samples = import.meta.glob<string>('../../../tests/web_contract/server/*.json', { eager: true, query: '?raw', import: 'default' });
const nameOf = (path: string) => path.slice(path.lastIndexOf('/') + 1, -'.json'.length);

/** Where a value is not what the contract says; empty: nowhere. */
function faults(value: unknown, shape: Shape, at: string): string[] {
  if (typeof shape === 'string') return typeof value === shape ? [] : [`${at} is no ${shape}: ${JSON.stringify(value)}`];
  const [kind, inner] = Object.entries(shape)[0] as [string, Shape & Shape[] & string[]];
  const list = Array.isArray(value) ? value : undefined;
  switch (kind) {
    case 'nullable':
      return value === null ? [] : faults(value, inner, at);
    case 'words':
      return inner.includes(value as string) ? [] : [`${at} is none of ${inner}: ${value}`];
    case 'list':
      return list?.flatMap((item, i) => faults(item, inner, `${at}[${i}]`)) ?? [`${at} is no list`];
    case 'tuple':
      if (list?.length !== inner.length) return [`${at} has not ${inner.length} parts`];
      return list.flatMap((item, i) => faults(item, inner[i], `${at}[${i}]`));
    case 'map':
      return Object.entries(value as object).flatMap(([key, item]) => faults(item, inner, `${at}.${key}`));
    case 'document':
      return documentFaults(value, inner as string, at);
  }
  return [`${at}: the contract has an unknown kind ${kind}`];
}
function documentFaults(value: unknown, name: string, at: string): string[] {
  if (typeof value !== 'object' || value === null) return [`${at} is no document`];
  const { type, fields, maybe } = table[name];
  const shapes: Record<string, Shape> = { ...fields, ...maybe, ...(type === undefined ? {} : { type: { words: [type] } }) };
  const unknown = Object.keys(value).filter((key) => !(key in shapes));
  return [
    ...unknown.map((key) => `${at}.${key} is not in the contract`),
    ...Object.entries(shapes).flatMap(([key, shape]) => {
      if (key in value) return faults((value as Record<string, unknown>)[key], shape, `${at}.${key}`);
      return key in maybe ? [] : [`${at}.${key} is missing`];
    }),
  ];
}
const documentOf = (type: string) => Object.keys(table).find((name) => table[name].type === type) ?? '';

test('the page understands every document of the server', () => {
  const seen = new Set<string>();
  for (const [path, text] of Object.entries(samples)) {
    const message = decode(text);
    const name = nameOf(path) === 'museum' ? 'Museum' : documentOf(message.type);
    seen.add(name);
    expect(documentFaults(message, name, nameOf(path))).toEqual([]);
  }
  const client = ['RequestMessage', 'CancelMessage', 'ChoiceMessage', 'VoteMessage', 'WatchMessage', 'LampsMessage', 'HelpMessage', 'SkipMessage', 'AnswerMessage', 'LeaseMessage', 'SteerMessage', 'StopMessage', 'SetHoursMessage'];
  const whole = Object.keys(table).filter((name) => table[name].type !== undefined && !client.includes(name));
  expect([...seen].sort()).toEqual([...whole, 'Museum'].sort());
});

test('a document that is not of the contract is found', () => {
  const live = JSON.parse(Object.entries(samples).find(([path]) => nameOf(path) === 'live')![1]);
  expect(documentFaults({ ...live, t: 'soon' }, 'LiveMessage', '')).toHaveLength(1);
  expect(documentFaults({ ...live, pose: [1, 2] }, 'LiveMessage', '')).toHaveLength(1);
  expect(documentFaults({ ...live, scan: { ...live.scan, frame: 'odom' } }, 'LiveMessage', '')).toHaveLength(1);
  expect(documentFaults({ ...live, more: 1 }, 'LiveMessage', '')).toHaveLength(1);
  delete live.v;
  delete live.battery;
  expect(documentFaults(live, 'LiveMessage', '')).toEqual(['.v is missing']);
});

test('the page moves with the frames of the server', () => {
  const motion = new Motion();
  for (const [path, text] of Object.entries(samples)) {
    if (nameOf(path).startsWith('live')) motion.add(decode(text) as LiveMessage);
  }
  expect(motion.latest?.type).toBe('live');
});

test('what the page says is what the server was tested with', () => {
  const id = '018f3a6c-5b2e-7c3d-9a4b-0123456789ab';
  const said = [
    requestOf({ id, kind: 'exhibit', target: 'sputnik', viewpoint: 3 }, 'Lise', 'de'),
    requestOf({ id, kind: 'tour', target: 'all', viewpoint: -1 }, '', 'en'),
    cancelOf(id, '018f3a6c-5b2e-7c3d-9a4b-ba9876543210'),
    choiceOf(id, 'prompt-17', 'more'),
    choiceOf(id, '1-17/more', 'next'),
    lampsOf([1, 4]),
    helpOf(id, 'fr'),
    skipOf(id, 'sputnik'),
    answerOf(id, 'intelligence', 'dog', 'en'),
    leaseOf(id, true),
    steerOf(true, 0.5, -0.25),
    stopOf(id, true, 0),
    setHoursOf(id, 'web'),
    voteOf(id, '018f3a6c-5b2e-7c3d-9a4b-0123456789ac', 'space'),
    watchOf(true),
    watchOf(false),
  ];
  for (const message of said) expect(documentFaults(message, documentOf(message.type), message.type)).toEqual([]);
  expect(said).toEqual(JSON.parse(clientText));
});

test('every reason has words of its own in each language, with a place for what it is about in all or in none', () => {
  const reasons: readonly Reason['word'][] = documents.Reason.fields.word.words;
  expect(reasons.length).toBeGreaterThan(20);
  const text = (language: string, reason: Reason['word'], about = '') => reasonText(language, { word: reason, about }, (id) => `<${id}>`);
  for (const language of pageLanguages) {
    expect(new Set(reasons.map((reason) => text(language, reason))).size).toBe(reasons.length);
    for (const reason of reasons) {
      expect(text(language, reason)).toMatch(/^\p{Lu}.*[.!]$/u);
      if (language !== 'en') expect(text(language, reason)).not.toBe(text('en', reason));
      expect(text(language, reason, 'a b').includes('<a>, <b>')).toBe(text('en', reason, 'a b').includes('<a>, <b>'));
    }
  }
  expect(text('de', 'not_reached', 'clock')).toBe('Ich kam nicht hin: <clock>.');
  expect(text('xx', 'closed')).toBe(text('en', 'closed'));
  expect(text('en', 'of a newer server' as Reason['word'])).toBe('');
});

test('a language that the robot speaks is on its pages, too', () => {
  const spoken = Object.keys(import.meta.glob('../../../src/docent/interaction/speech/languages/*.yaml', { query: '?raw' }));
  const codes = spoken.map((path) => path.slice(path.lastIndexOf('/') + 1, -'.yaml'.length)).sort();
  expect(codes.length).toBeGreaterThan(2);
  expect([...pageLanguages].sort()).toEqual(codes);
  expect([...kioskLanguages].sort()).toEqual(codes);
});

test('every dictionary is whole, and who wants another language gets the first of the museum', () => {
  expect(pageLanguages).toContain('en');
  expect(pageLanguages).toContain('de');
  for (const language of pageLanguages) {
    expect(word(language, 'takeMe')).not.toBe('');
    expect(phaseWord(language, 'charging')).not.toBe(phaseWord(language, 'nothing of the kind'));
  }
  expect(word('de', 'no')).toBe('Nein');
  expect(pageLanguage('de', ['en'])).toBe('de');
  expect(pageLanguage('xx', ['de', 'en'])).toBe('de');
  expect(pageLanguage('xx', [])).toBe('en');
});
