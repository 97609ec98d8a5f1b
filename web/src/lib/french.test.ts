import { expect, test } from 'vitest';
import { parsed, spaced } from './french';

test('a text keeps its length, and breaks before no sign', () => {
  expect(spaced('Vraiment ! Oui : « bien » ; non ?')).toBe('Vraiment\u00a0! Oui\u00a0: «\u00a0bien\u00a0»\u00a0; non\u00a0?');
  expect(spaced("L'aile d'un Airbus")).toBe('L’aile d’un Airbus');
  expect(spaced('à 10:30, ou :hover')).toBe('à 10:30, ou :hover');
  expect(parsed('{"fr": "Allez !", "en": "Go !"}')).toEqual({ fr: 'Allez\u00a0!', en: 'Go !' });
});

const sources = import.meta.glob<string>(['../**/words/fr.ts', '../**/words.ts'], { eager: true, query: '?raw', import: 'default' });
/** Every file of the page that has French words, with these words. */
function catalogues(): [string, string][] {
  return Object.entries(sources).flatMap(([file, text]): [string, string][] => {
    if (file.endsWith('/fr.ts')) return [[file, text]];
    const french = /const fr\b[^=]*= \{\n([\s\S]*?)\n\};/.exec(text);
    return french ? [[file, french[1]]] : [];
  });
}
test('no catalogue breaks a line before a sign, or sets one without a space', () => {
  const found = catalogues();
  expect(found.length).toBeGreaterThanOrEqual(6);
  const faults: string[] = [];
  for (const [file, text] of found)
    for (const line of text.split('\n')) {
      const said = /^\s*(?:[\w']+): ['"`](.*)['"`],?$/.exec(line)?.[1];
      if (said === undefined) continue;
      if (spaced(said) !== said) faults.push(`${file}: a common space before a sign: ${said}`);
      if (/[\p{L}»}][!?;:](?=\s|$)/u.test(said)) faults.push(`${file}: no space before a sign: ${said}`);
    }
  expect(faults).toEqual([]);
});
