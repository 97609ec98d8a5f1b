// French writes ’ between letters, and sets a space before ! ? : ; and inside « », at which no line may break. Whoever writes types a common one.

const NO_BREAK = '\u00a0';

/** The same text with spaces that do not break; none is added, so that places in the text stay. */
export const spaced = (text: string): string => text.replace(/(?<=\p{L})'(?=\p{L})/gu, '’').replace(/ (?=[!?:;»](?![^\s!?:;»)\].,…]))/g, NO_BREAK).replace(/« /g, `«${NO_BREAK}`);

const revive = (key: string, value: unknown): unknown => (key === 'fr' && typeof value === 'string' ? spaced(value) : value);
/** JSON of the server, whose French texts are those of people or of the robot. */
export const parsed = (json: string): unknown => JSON.parse(json, json.includes('"fr":') ? revive : undefined);
