import en, { type Words } from '../words/en';
import type { Reason } from './protocol';

/** The dictionaries: every file of words/, by the code of its language. */
const files = import.meta.glob<Words>('../words/*.ts', { eager: true, import: 'default' });
const dictionaries = new Map(Object.entries(files).map(([path, words]) => [path.slice(path.lastIndexOf('/') + 1, -3), words]));

export type WordKey = keyof Words;
/** The languages that the page speaks. */
export const pageLanguages = [...dictionaries.keys()];

/** That of them which the reader gets: what they want, else what the museum speaks first, else the one that is always there. */
export function pageLanguage(wanted: string, museum: string[]): string {
  return [wanted, ...museum].find((language) => dictionaries.has(language)) ?? 'en';
}
export function word(language: string, key: WordKey): string {
  return (dictionaries.get(language) ?? en)[key];
}
/**
 * Why, in the reader's words; `titleOf` tells an exhibit's title. A reason without words does not compile; a page that
 * was opened before its server became a newer one may still hear of one, and says nothing then.
 */
export function reasonText(language: string, reason: Reason, titleOf: (id: string) => string): string {
  const text: string | undefined = word(language, `reason_${reason.word}`);
  return text?.replace('{}', () => reason.about.split(' ').map(titleOf).join(', ')) ?? '';
}
export function phaseWord(language: string, phase: string): string {
  const table = dictionaries.get(language) ?? en;
  return table[`phase_${phase}` as WordKey] ?? table.phase_;
}
