import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { parsed, spaced } from './french';

test('a text keeps its length, and breaks before no sign', () => {
  expect(spaced('Vraiment ! Oui : « bien » ; non ?')).toBe('Vraiment\u00a0! Oui\u00a0: «\u00a0bien\u00a0»\u00a0; non\u00a0?');
  expect(spaced('à 10:30, ou :hover')).toBe('à 10:30, ou :hover');
  expect(parsed('{"fr": "Allez !", "en": "Go !"}')).toEqual({ fr: 'Allez\u00a0!', en: 'Go !' });
});

/** Every file of the page that has French words, with these words. */
function catalogues(): [string, string][] {
  const source = join(__dirname, '..');
  const files = readdirSync(source, { recursive: true, encoding: 'utf8' });
  return files.flatMap((file): [string, string][] => {
    if (/words[\\/]fr\.ts$/.test(file)) return [[file, readFileSync(join(source, file), 'utf8')]];
    if (!/words\.ts$/.test(file)) return [];
    const french = /const fr\b[^=]*= \{\n([\s\S]*?)\n\};/.exec(readFileSync(join(source, file), 'utf8'));
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
