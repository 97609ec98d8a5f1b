import { pageLanguages } from '../lib/words';

/**
 * In which a museum may speak: those in which pages, screen and the robot's own phrases are whole. Whoever wants another
 * one adds it in museum.yaml.
 */
export const LANGUAGES: Record<string, string> = Object.fromEntries(
  pageLanguages.map((code) => {
    const name = new Intl.DisplayNames([code], { type: 'language' }).of(code) ?? code;
    return [code, name[0].toLocaleUpperCase(code) + name.slice(1)];
  }).sort(([a], [b]) => (a === 'en' ? -1 : b === 'en' ? 1 : a.localeCompare(b))),
);
