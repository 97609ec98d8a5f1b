import { afterEach, expect, test, vi } from 'vitest';
import { addressOf, keptAs, lineOf } from './site';

const at = (baseURI: string) => vi.stubGlobal('document', { baseURI });
afterEach(() => vi.unstubAllGlobals());

test('a page that is the whole site calls the server by its own paths', () => {
  at('http://127.0.0.1:8080/kiosk#key');
  expect(addressOf('/api/museum.json')).toBe('http://127.0.0.1:8080/api/museum.json');
  expect(lineOf('/live?screen=key')).toBe('ws://127.0.0.1:8080/live?screen=key');
  expect(keptAs('wishes')).toBe('docent.wishes');
});

test('a page below a path calls what lies below it', () => {
  for (const page of ['', 'operate', 'index.html', 'kiosk#key', '?a=/b/']) {
    at(`https://museum.example/hall/robot/${page}`);
    expect(addressOf('/audio/5a.wav')).toBe('https://museum.example/hall/robot/audio/5a.wav');
    expect(addressOf('/api/growing.png?3')).toBe('https://museum.example/hall/robot/api/growing.png?3');
    expect(lineOf('/operate')).toBe('wss://museum.example/hall/robot/operate');
    expect(keptAs('wishes')).toBe('docent/hall/robot.wishes');
  }
});
