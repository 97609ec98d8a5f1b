// What the tests of the pages share: the web module among invented messages, a museum of three languages, and a channel
// on which a test can say what the robot would say.
import { cpSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { answers, browse, build, freePort, root, start, temporaryFolder } from './harness.mjs';

const program = join(build, 'tests', 'web_stage', 'docent_web_stage');
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core'), 'utf8');

/** The hall of Bonn with one picture, short texts, and its first tour cut down to two exhibits. */
export function museumOfThreeLanguages() {
  const folder = join(temporaryFolder('museum'), 'bonn');
  cpSync(join(root, 'museums', 'bonn'), folder, { recursive: true });
  const file = join(folder, 'museum.yaml');
  const text = readFileSync(file, 'utf8')
    .replace(/exhibits: \[zuse, transrapid[^\]]*\]/, 'exhibits: [zuse, transrapid]')
    .replace(/^ {4}picture: .*\n/gm, '')
    .replace('  - id: transrapid\n', '  - id: transrapid\n    picture: content/transrapid.svg\n');
  writeFileSync(file, text);
  for (const name of readdirSync(join(folder, 'content'))) {
    if (name.endsWith('.fr.md')) writeFileSync(join(folder, 'content', name), 'Voici une petite histoire en français. Elle est vite racontée.\n');
  }
  for (const name of ['zuse', 'transrapid']) {
    for (const [kind, words] of [['short', 'This is a short story. It is told soon.'], ['long', 'This is the long story. It has a few more words than the short one, and then it ends.']]) {
      writeFileSync(join(folder, 'content', `${name}.${kind}.en.md`), `${words}\n`);
    }
  }
  writeFileSync(join(folder, 'content', 'transrapid.svg'), `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 300"><rect width="480" height="300" fill="#cfe6f5"/><path d="M0 240h480v60H0z" fill="#7a8a99"/><path d="M40 220q10-110 150-110h250v110z" fill="#f4f4f4" stroke="#2c2740" stroke-width="6"/><path d="M90 165q25-35 90-35h40v45H85z" fill="#35507a"/><path d="M240 130h50v45h-50zM310 130h50v45h-50zM380 130h45v45h-45z" fill="#35507a"/><path d="M40 200h400v14H40z" fill="#d2382a"/></svg>`);
  return folder;
}

/** Starts the stage; `key`: of the robot's own screen. */
export async function play(museum, ...words) {
  const port = await freePort();
  const state = temporaryFolder('stage');
  const stage = start(program, [museum, state, String(port), 'lost=0.5', 'speed=2', 'talk=0.25', 'people=3', ...words]);
  const url = `http://127.0.0.1:${port}`;
  await answers(`${url}/api/health`);
  const key = readFileSync(join(state, 'screen.key'), 'utf8').trim();
  return { url, state, key, port, stage, again: () => start(program, [museum, state, String(port), 'lost=0.5', 'speed=2', 'talk=0.25', 'people=3', ...words]) };
}

/** A browser whose channel goes through the test: `say` puts a message in place of the robot's of its type. */
export async function listen(options = {}) {
  const browser = await browse(options);
  const robot = { t: 0, instead: new Map(), sockets: new Set(), sent: [] };
  await browser.page.routeWebSocket(/\/live/, (socket) => {
    robot.sockets.add(socket);
    const server = socket.connectToServer();
    socket.onMessage((text) => {
      robot.sent.push(JSON.parse(text));
      server.send(text);
    });
    server.onMessage((text) => {
      const message = JSON.parse(text);
      if (message.type === 'live') robot.t = message.t;
      const instead = robot.instead.get(message.type);
      socket.send(JSON.stringify(instead ? { ...message, ...(typeof instead === 'function' ? instead(message) : instead) } : message));
    });
  });
  robot.say = (message) => {
    robot.instead.set(message.type, message);
    for (const socket of robot.sockets) socket.send(JSON.stringify(message));
  };
  robot.mission = (phase, more = {}) =>
    robot.say({ type: 'mission', phase, tour: '', exhibit: '', text: {}, agenda: [], explained: 0, tours: 0, served: 0, prompt: null, ...more });
  return { ...browser, robot };
}

/** What axe-core finds, a sentence each. */
export async function axeSays(page) {
  if (!(await page.evaluate(() => !!window.axe))) await page.evaluate(axe);
  return page.evaluate(async () => (await window.axe.run(document)).violations.map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 200)} ${v.nodes[0].any[0]?.message ?? ''}`));
}
