import en, { type KioskWords } from './words/en';

/** The dictionaries of the robot's own screen: every file of words/, by the code of its language. */
const files = import.meta.glob<KioskWords>('./words/*.ts', { eager: true, import: 'default' });
const dictionaries = new Map(Object.entries(files).map(([path, words]) => [path.slice(path.lastIndexOf('/') + 1, -3), words]));

export type KioskWord = keyof KioskWords;
/** The languages that the screen speaks. */
export const kioskLanguages = [...dictionaries.keys()];

export function kioskWord(language: string, key: KioskWord): string {
  return (dictionaries.get(language) ?? en)[key];
}
/** A language's own name, such as "Deutsch". */
export function nameOf(language: string): string {
  const name = new Intl.DisplayNames([language], { type: 'language' }).of(language) ?? language;
  return name.charAt(0).toLocaleUpperCase(language) + name.slice(1);
}
