// Operators, with the whole robot in the simulated museum: log in, stop it, steer it through its collision avoidance,
// say whose hours these are; and what becomes of the wheel when a line breaks.
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { browse, build, check, ensure, finish, freePort, pause, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { axeSays } from './stage.mjs';

const docent = join(build, 'bin', 'docent');
const state = temporaryFolder('operate');
const PASSWORD = 'a long way from Bonn';
for (const [name, role] of [['ada', 'operator'], ['grace', 'operator'], ['mary', 'moderator']]) {
  const made = spawnSync(docent, ['web-account', 'add', name, '--role', role, '--state', state], { input: `${PASSWORD}\n`, encoding: 'utf8' });
  ensure(made.status === 0, made.stderr);
}
const port = String(await freePort());
const robot = start(docent, [
  'up', '--sim', '--museum', join(root, 'museums', 'bonn'), '--crowd', 'quiet', '--requests-per-hour', '0', '--no-cameras', '--port', port,
  '--domain', process.env.DOCENT_TEST_DOMAIN ?? '65', '--state', state,
]);
const url = `http://127.0.0.1:${port}/`;
await until('the page answers', async () => {
  ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
  return fetch(url).then((reply) => reply.ok, () => false);
}, 60000);

async function visit(options) {
  const browser = await browse(options);
  await browser.page.goto(`${url}operate`);
  await browser.page.waitForSelector('.login[data-rank=viewer]');
  return browser;
}
async function logIn(page, name, password = PASSWORD) {
  await page.locator('.login input').first().fill(name);
  await page.locator('.login input[type=password]').fill(password);
  await page.locator('.login button[type=submit]').click();
}
/** What the robot says of itself, on a connection of the test's own. */
const watcher = await browse();
await watcher.page.goto(`${url}metrics`);
await watcher.page.evaluate(() => {
  window.heard = { v: 0, w: 0, reason: '' };
  const socket = new WebSocket(`ws://${location.host}/live`);
  socket.onmessage = (event) => {
    const message = JSON.parse(event.data);
    if (message.type === 'live') window.heard = { v: message.v, w: message.w, reason: message.avoid?.reason?.word ?? '' };
  };
});
const heard = () => watcher.page.evaluate(() => window.heard);
/** Waits until what the robot says of itself is so. */
const robotDoes = (what, condition, patience = 5000) => until(what, async () => condition(await heard()), patience, 50);

const { page, complaints } = await visit({ viewport: { width: 1280, height: 900 } });
await check('a wrong password is refused, and nothing is shown', async () => {
  await logIn(page, 'ada', 'not the password');
  await page.waitForSelector('.toast.shown');
  ensure((await page.locator('.stop-button').count()) === 0, 'a stop button for anybody');
  complaints.length = 0; // the browser complains of 401
});
await check('nobody opens the operators’ line without a login', async () => {
  const opened = await page.evaluate(() => new Promise((resolve) => {
    const socket = new WebSocket(`ws://${location.host}/operate`);
    socket.onopen = () => resolve(true);
    socket.onclose = () => resolve(false);
  }));
  ensure(!opened, 'it opened');
  complaints.length = 0;
});
await check('an operator logs in and sees everything', async () => {
  await logIn(page, 'ada');
  await page.waitForSelector('.stop[data-open=true]');
  for (const part of ['.steer', '.field canvas', '.mission', '.inside .velocities', '.moderation', '.statistics', '.audit'])
    await page.waitForSelector(part);
  await page.waitForSelector('.map[data-localized=true]', { timeout: 300000 });
  await until('the field is drawn', () => page.evaluate(() => {
    const canvas = document.querySelector('.field canvas');
    const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) colours.add(`${data[i]},${data[i + 1]},${data[i + 2]}`);
    return colours.size > 4;
  }));
  await page.screenshot({ path: join(pictures, 'operate-logged-in.png') });
});

await check('the stop button stops the robot and shows it', async () => {
  await page.locator('.stop-button').click();
  await page.waitForSelector('.stop[data-stopped=true]');
  await robotDoes('it stands', (now) => now.reason === 'stopped_by_hand' && Math.abs(now.v) < 0.02, 5000);
  await page.screenshot({ path: join(pictures, 'operate-stopped.png') });
});
await check('a stop outlives a reload, and is taken back', async () => {
  await page.reload();
  await page.waitForSelector('.stop[data-stopped=true]');
  await page.locator('.stop button.plain').click();
  await page.waitForSelector('.stop[data-stopped=false]');
  await robotDoes('it may move', (now) => now.reason !== 'stopped_by_hand', 5000);
});

const pad = page.locator('.pad');
async function pull(dx, dy) {
  const box = await pad.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + (dx * box.width) / 2, y - (dy * box.height) / 2, { steps: 4 });
}
await check('with the wheel the robot is turned and driven, and stands when the hand lets go', async () => {
  await page.locator('.steer .go').click();
  await page.waitForSelector('.steer[data-wheel=true]');
  await robotDoes('it waits for the hand', (now) => now.reason === 'steered_by_hand', 5000);
  await pad.scrollIntoViewIfNeeded();
  await pull(-0.8, 0);
  await robotDoes('it turns', (now) => now.w > 0.2, 8000);
  await page.screenshot({ path: join(pictures, 'operate-steering.png') });
  await page.mouse.up();
  await robotDoes('it stands', (now) => Math.abs(now.w) < 0.05, 3000);
  // It drives where there is room: whatever lies ahead, it touches nothing.
  let driven = false;
  for (let i = 0; i < 6 && !driven; i++) {
    await pull(0, 0.9);
    driven = await robotDoes('it drives', (now) => now.v > 0.15, 4000).catch(() => false);
    await page.mouse.up();
    if (driven) break;
    await pull(-0.9, 0);
    await pause(1500);
    await page.mouse.up();
  }
  ensure(driven, 'it never drove');
  const released = Date.now();
  await robotDoes('it stands', (now) => Math.abs(now.v) < 0.03, 4000);
  ensure(Date.now() - released < 3000, `it stood after ${Date.now() - released} ms`);
});
await check('the keyboard steers too, with the space bar held', async () => {
  await page.keyboard.down('ArrowLeft');
  await pause(800);
  ensure(Math.abs((await heard()).w) < 0.05, 'it turned without the dead man’s switch');
  await page.keyboard.down(' ');
  await robotDoes('it turns', (now) => now.w > 0.2, 8000);
  await page.keyboard.up(' ');
  await robotDoes('it stands', (now) => Math.abs(now.w) < 0.05, 3000);
  await page.keyboard.up('ArrowLeft');
});

const other = await visit({ viewport: { width: 390, height: 844 }, hasTouch: true });
await check('another operator sees who has the wheel, and cannot take it', async () => {
  await logIn(other.page, 'grace');
  await other.page.waitForSelector('.stop[data-open=true]');
  await until('it is so', () => other.page.evaluate(() => document.querySelector('.steer')?.textContent.includes('ada')));
  ensure(await other.page.locator('.steer .go').isDisabled(), 'she could take it');
  const said = await other.page.evaluate(() => new Promise((resolve) => {
    const socket = new WebSocket(`ws://${location.host}/operate`);
    socket.onopen = () => socket.send(JSON.stringify({ type: 'steer', pressed: true, forward: 1, turn: 0 }));
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type === 'error') resolve(message.reason.word);
    };
  }));
  ensure(said === 'no_lease', said);
  ensure(Math.abs((await heard()).v) < 0.03, 'it moved');
  await other.page.screenshot({ path: join(pictures, 'operate-phone.png'), fullPage: false });
});
await check('a page that dies while it steers lets the robot stand, and the wheel is free', async () => {
  await pull(-0.8, 0);
  await robotDoes('it turns', (now) => now.w > 0.2, 8000);
  await page.context().setOffline(true); // the line is cut; no farewell
  await page.evaluate(() => undefined);
  await page.close();
  const cut = Date.now();
  await robotDoes('it stands', (now) => Math.abs(now.w) < 0.05, 4000);
  ensure(Date.now() - cut < 2500, `it stood after ${Date.now() - cut} ms`);
  await until('it is so', () => other.page.evaluate(() => !document.querySelector('.steer .go').disabled), 8000);
});
await check('the stop button needs no wheel, and works by touch', async () => {
  await other.page.locator('.stop-button').tap();
  await other.page.waitForSelector('.stop[data-stopped=true]');
  await other.page.locator('.stop button.plain').tap();
  await other.page.waitForSelector('.stop[data-stopped=false]');
});
await check('an operator sends it into the next room', async () => {
  const { rooms } = await (await fetch(`${url}api/museum.json`)).json();
  await other.page.locator('.mission [data-order=next-room]').tap();
  await until('it says so', async () => {
    const text = (await other.page.locator('.mission p').first().innerText()).toLowerCase();
    return rooms.some((room) => text.includes(room.name.en.toLowerCase()));
  });
  await other.page.locator('.mission').scrollIntoViewIfNeeded();
  await other.page.screenshot({ path: join(pictures, 'operate-next-room.png') });
  await robotDoes('it drives', (now) => now.v > 0.15, 60000);
});
await check('an operator says whose hours these are', async () => {
  await other.page.locator('.hours .choices button').nth(2).tap();
  await other.page.waitForSelector('.hours[data-mode=web]');
  await other.page.locator('.hours .choices button').nth(1).tap();
  await other.page.waitForSelector('.hours[data-mode=open]');
});
await check('all of it is in the audit log', async () => {
  await other.page.locator('.audit summary').tap();
  await until('it is so', () => other.page.evaluate(() => {
    const text = document.querySelector('.audit')?.textContent ?? '';
    return ['wrong_password', 'login', 'lease taken', 'stop pressed', 'hours web'].every((one) => text.includes(one));
  })).catch(async () => ensure(false, await other.page.locator('.audit').textContent()));
});
await check('counts are shown', async () => {
  await until('something was counted', async () => {
    await other.page.waitForSelector('.statistics td');
    return Number(await other.page.locator('[data-count=c_accesses]').textContent()) > 0;
  }, 60000);
  await other.page.locator('.statistics').scrollIntoViewIfNeeded();
  await other.page.screenshot({ path: join(pictures, 'operate-statistics.png') });
});
await check('the page is accessible', async () => {
  const found = await axeSays(other.page);
  ensure(found.length === 0, JSON.stringify(found).slice(0, 1500));
});
await check('a moderator reads the forum and drives nothing', async () => {
  const moderator = await visit({ viewport: { width: 1280, height: 900 } });
  await logIn(moderator.page, 'mary');
  await moderator.page.waitForSelector('.moderation');
  ensure((await moderator.page.locator('.stop-button, .steer, .hours').count()) === 0, 'she could');
  moderator.complaints.length = 0;
});
await check('the pages complain of nothing', async () => ensure(complaints.concat(other.complaints).length === 0, complaints.concat(other.complaints).join('\n')));
await finish();
