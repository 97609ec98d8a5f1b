// The page below a path of somebody's site, through the proxies of docs/proxies.md as it configures them: every file is
// found, lines open, logins hold, a wish is made, and viewers of ROS 2 look in.
import { spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { browse, build, check, ensure, finish, pictures, root, until } from './harness.mjs';
import { PASSWORD_OF_GUIDE, apache, ask, ca, caddy, nginx, settings } from './proxies.mjs';
import { museumOfThreeLanguages, play } from './stage.mjs';

const others = createRequire(join(root, 'tests', 'recording_npm', 'package.json'));
const WebSocket = others('ws');
const { FoxgloveClient } = others('@foxglove/ws-protocol');
const { parse } = others('@foxglove/rosmsg');
const { MessageReader } = others('@foxglove/rosmsg2-serialization');
const PASSWORD = 'a long way from Bonn';

const robot = await play(museumOfThreeLanguages(), ...settings.map((setting) => `set=${setting}`));
const added = spawnSync(join(build, 'bin', 'docent'), ['web-account', 'add', 'ada', '--role', 'operator', '--state', robot.state], { input: `${PASSWORD}\n`, encoding: 'utf8' });
ensure(added.status === 0, added.stderr);
const { taken, passed } = await nginx(robot.port);
const fronts = [['nginx, https', taken], ['nginx, with the path passed on', passed], ['Apache', await apache(robot.port)]];
const third = await caddy(robot.port);
if (third) fronts.push(['Caddy', third]);
else console.log('skipped: Caddy is not installed');

/** What comes of opening a line: the first message, the connection's sub-protocol; or the status of the refusal. */
function line(url, { protocols = [], headers = {} } = {}) {
  return new Promise((resolve) => {
    const socket = new WebSocket(url.replace(/^http/, 'ws'), protocols, { ca, headers: { Origin: new URL(url).origin, ...headers } });
    const timer = setTimeout(() => end({ status: 'nothing came' }), 10000);
    function end(what) {
      clearTimeout(timer);
      resolve(what);
      socket.terminate();
    }
    socket.once('message', (text) => end({ status: 101, protocol: socket.protocol, message: JSON.parse(text) }));
    socket.once('error', (error) => end({ status: Number(String(error.message).match(/\d{3}$/)?.[0]) || String(error.message) }));
  });
}
/** Somebody who calls /api/v1 as a page does. */
function caller(front) {
  const who = { cookie: '', csrf: '', set: '' };
  who.call = async (method, path, body) => {
    const reply = await ask(`${front}api/v1${path}`, { method, body, headers: { Origin: new URL(front).origin, Cookie: who.cookie, 'Docent-Csrf': who.csrf } });
    const said = JSON.parse(reply.bytes);
    ensure(reply.status === 200, `${method} ${path}: ${reply.status} ${JSON.stringify(said)}`);
    if (reply.headers['set-cookie']) [who.set] = reply.headers['set-cookie'];
    if (who.set) [who.cookie] = who.set.split(';');
    if (said.csrf !== undefined) who.csrf = said.csrf;
    return said;
  };
  return who;
}

const files = readdirSync(join(root, 'web', 'dist', 'assets'));
for (const [name, front] of fronts) {
  await check(`${name}: all files are found`, async () => {
    const bare = await ask(front.slice(0, -1));
    ensure([301, 302, 308].includes(bare.status) && new URL(bare.headers.location, front.slice(0, -1)).href === front, `${bare.status} ${bare.headers.location}`);
    for (const page of ['', 'operate', 'kiosk', 'face', 'setup']) {
      const text = String((await ask(`${front}${page}`)).bytes);
      const named = [...text.matchAll(/(?:href|src)="([^"]+)"/g)].map(([, address]) => new URL(address, `${front}${page}`).href);
      ensure(named.length > 3 && named.every((address) => address.startsWith(front)), `${page}: ${named}`);
      for (const address of named) ensure((await ask(address)).status === 200, address);
    }
    for (const file of files) ensure((await ask(`${front}assets/${file}`)).status === 200, file);
    for (const path of ['api/museum.json', 'api/map.png', 'api/health', 'metrics', 'audio/5a5a5a5a.wav', 'api/pictures/transrapid.svg'])
      ensure((await ask(`${front}${path}`)).status === 200, path);
  });
  await check(`${name}: cookies are for the path, and for https where it is`, async () => {
    const eve = caller(front);
    await eve.call('POST', '/visitor', { name: `Eve ${front.length}${name.length}` });
    ensure(eve.set.includes('; Path=/robot/;'), eve.set);
    ensure(/; Secure(;|$)/.test(eve.set) === front.startsWith('https'), eve.set);
    ensure((await eve.call('GET', '/login')).name.startsWith('Eve'), 'nobody knows her');
  });
  await check(`${name}: lines open for pages of the site, and for no others`, async () => {
    const opened = await line(`${front}live`);
    ensure(opened.message?.type, JSON.stringify(opened));
    for (const origin of ['https://evil.example', `http://127.0.0.1:${robot.port}`, ...(front.startsWith('https') ? [front.replace('https', 'http').slice(0, -7)] : [])])
      ensure((await line(`${front}live`, { headers: { Origin: origin } })).status === 403, origin);
  });
}
await check('an operator steers, and changes a museum with all its texts', async () => {
  for (const [name, front] of fronts) {
    const ada = caller(front);
    ensure((await line(`${front}operate`)).status === 403, `${name}: for anybody`);
    await ada.call('POST', '/login', { name: 'ada', password: PASSWORD });
    ensure((await line(`${front}operate`, { headers: { Cookie: ada.cookie } })).message, `${name}: not for her`);
    const { draft } = await ada.call('GET', '/museum');
    ensure(JSON.stringify(draft).length > 16384, 'a small museum');
    await ada.call('POST', '/museum/check', draft);
  }
});
await check('Foxglove and Lichtblick look in, and whoever has no password does not', async () => {
  ensure((await line(`${taken}foxglove`, { protocols: ['foxglove.sdk.v1'] })).status === 401, 'without a password');
  for (const offered of [[FoxgloveClient.SUPPORTED_SUBPROTOCOL], ['foxglove.sdk.v1'], [FoxgloveClient.SUPPORTED_SUBPROTOCOL, 'foxglove.sdk.v1']]) {
    const socket = new WebSocket(`${taken.replace('https', 'wss')}foxglove`, offered, { ca, auth: `guide:${PASSWORD_OF_GUIDE}` });
    const client = new FoxgloveClient({ ws: socket });
    const channels = await new Promise((resolve, reject) => {
      client.on('advertise', resolve);
      client.on('error', reject);
    });
    ensure(socket.protocol === offered[0], `${offered}: ${socket.protocol}`);
    const channel = channels.find(({ topic }) => topic === '/scan_front');
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    const scan = await new Promise((resolve) => {
      client.on('message', ({ data }) => resolve(reader.readMessage(data)));
      client.subscribe(channel.id);
    });
    ensure(scan.ranges.length > 10, `${offered}: no scan`);
    client.close();
  }
  ensure((await line(`${taken}foxglove`, { protocols: ['mqtt'], headers: { Origin: new URL(taken).origin, Authorization: `Basic ${btoa(`guide:${PASSWORD_OF_GUIDE}`)}` } })).status === 400, 'a protocol that nobody knows');
});

// What a browser asks for, and what comes.
const { page, complaints, hosts } = await browse({ ignoreHTTPSErrors: true });
const asked = [];
page.on('response', (reply) => asked.push([reply.status(), reply.url()]));
page.on('websocket', (socket) => asked.push([101, socket.url().replace(/^ws/, 'http')]));
const shot = (name) => page.screenshot({ path: join(pictures, `proxy-${name}.png`) });

await check('a visitor sees the robot and makes a wish', async () => {
  await page.goto(taken);
  await page.waitForSelector('.map[data-ready=true]');
  await page.waitForSelector('[data-connection=open]');
  await page.waitForSelector('.map[data-localized=true]');
  await page.click('[data-exhibit=transrapid]');
  await page.waitForSelector('.exhibit-card img.picture');
  await until('its picture is there', () => page.evaluate(() => document.querySelector('.exhibit-card img.picture').naturalWidth > 0));
  await shot('card');
  await page.fill('.who input', 'Emmy');
  await page.click('.go');
  await page.locator('.queue li.mine[data-target=transrapid]:not([data-state=sending])').waitFor();
  const kept = await page.evaluate(() => Object.keys(localStorage));
  ensure(kept.length > 0 && kept.every((key) => key.startsWith('docent/robot.')), kept.join(', '));
  await shot('visitor');
});
await check('an operator logs in, and the museum editor opens', async () => {
  await page.goto(`${taken}operate`);
  await page.waitForSelector('.login[data-rank=viewer]');
  await page.locator('.login input').first().fill('ada');
  await page.locator('.login input[type=password]').fill(PASSWORD);
  await page.locator('.login button[type=submit]').click();
  await page.waitForSelector('.stop[data-open=true]');
  await page.reload();
  await page.waitForSelector('.stop[data-open=true]');
  await page.locator('.edit-museum').click();
  await page.waitForSelector('.museum-card [data-do=check]');
  await page.locator('.museum-card [data-do=check]').click();
  await shot('operate');
});
await check('the screen, the face and the page of setting up are whole', async () => {
  await page.goto(`${taken}kiosk#${robot.key}`);
  await page.waitForSelector('main[data-screen]:not([data-screen=silent])');
  await shot('kiosk');
  await page.goto(`${taken}face`);
  await page.waitForSelector('main[data-connection=open]');
  await shot('face');
  ensure(complaints.length === 0, complaints.join('; '));
  await page.goto(`${taken}setup`);
  await page.locator('.setup h2').waitFor();
  await until('it is told that nothing is set up', () => asked.some(([status, url]) => status === 404 && url === `${taken}api/v1/setup`));
  await shot('setup');
});
await check('nothing was asked for beside the path, and nothing was missing', async () => {
  const missing = asked.filter(([status, url]) => (status >= 400 && url !== `${taken}api/v1/setup`) || (!url.startsWith(taken) && !/^(blob|data):/.test(url)));
  ensure(missing.length === 0, JSON.stringify(missing.slice(0, 5)));
  ensure(asked.filter(([status]) => status === 101).length >= 4, 'lines');
  ensure([...hosts].every((host) => host === new URL(taken).host), [...hosts].join(', '));
});
await finish();
