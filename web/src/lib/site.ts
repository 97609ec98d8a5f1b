// Where the page lies. A proxy may show it below a path of its site, so every address counts from the page's own folder:
// the server's "/live" is "https://museum.example/robot/live" there.

/** The address of a path of the server. */
export const addressOf = (path: string): string => new URL(path.replace(/^\//, ''), document.baseURI).href;

/** Likewise, of a WebSocket. */
export const lineOf = (path: string): string => addressOf(path).replace(/^http/, 'ws');

/** Under which name this page keeps something in the browser: pages of several robots of one site keep theirs apart. */
export const keptAs = (key: string): string => `docent${new URL('.', document.baseURI).pathname.slice(0, -1)}.${key}`;
