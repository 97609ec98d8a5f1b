// A line that dies without a word: neither end is told, nothing arrives any more. The page must notice by itself.
import { createConnection, createServer } from 'node:net';
import { join } from 'node:path';
import { answers, browse, build, check, ensure, finish, freePort, onEnd, pause, root, start, temporaryFolder, until } from './harness.mjs';

/** Forwards to `port` until it is cut: from then on every byte of either side is swallowed and nobody is told. */
async function lineTo(port) {
  const line = { isCut: false, swallowed: 0 };
  const ends = new Set();
  const server = createServer((near) => {
    const far = line.isCut ? null : createConnection(port, '127.0.0.1');
    const isDead = () => line.isCut || near.isDead;
    for (const [from, to] of [[near, far], [far, near]]) {
      if (!from) continue;
      ends.add(from);
      from.on('data', (bytes) => {
        if (isDead() || !to) line.swallowed += bytes.length;
        else to.write(bytes);
      });
      from.on('end', () => isDead() || to?.end());
      from.on('error', () => isDead() || to?.destroy());
      from.on('close', () => ends.delete(from));
    }
    near.isDead = !far;
    near.far = far;
  });
  server.on('connection', (near) => (line.near ??= new Set()).add(near));
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  line.port = server.address().port;
  line.cut = () => {
    line.isCut = true;
    for (const near of line.near) near.isDead = true;
  };
  /** New connections come through; those that were cut stay dead. */
  line.mend = () => (line.isCut = false);
  onEnd(() => {
    for (const end of ends) end.destroy();
    server.close();
  });
  return line;
}

const port = await freePort();
const program = join(build, 'tests', 'web_stage', 'docent_web_stage');
start(program, [join(root, 'museums', 'bonn'), temporaryFolder('stage'), String(port), 'lost=1', 'speed=2', 'talk=0.25', 'people=5']);
await answers(`http://127.0.0.1:${port}/`);
const line = await lineTo(port);
const { page, complaints } = await browse();
/** All that the page has told in its notices. */
const told = () => page.evaluate(() => window.told.join(' | '));
const row = (target) => page.locator(`.queue li.mine[data-target=${target}]`);
async function wish(target) {
  await page.click(`[data-exhibit=${target}]`);
  await page.click('.go');
}

await check('a wish is promised only when the robot has it', async () => {
  await page.goto(`http://127.0.0.1:${line.port}/`);
  await page.waitForSelector('.map[data-ready=true]');
  await page.waitForSelector('[data-connection=open]');
  await page.evaluate(() => {
    window.told = [];
    const toast = document.querySelector('.toast');
    new MutationObserver(() => toast.innerText && window.told.push(toast.innerText)).observe(toast, { childList: true, characterData: true, subtree: true });
  });
  await wish('cyclotron');
  await until('the promise', async () => (await told()).includes('Coming!'), 3000);
});

await check('a line cut in silence is noticed within five seconds', async () => {
  const connects = page.waitForEvent('websocket', { timeout: 15000 }).catch(() => null);
  line.cut();
  const begin = Date.now();
  await page.evaluate(() => (window.told = []));
  await wish('zuse'); // nobody knows yet
  await row('zuse').filter({ hasText: 'sending' }).waitFor({ timeout: 2000 });
  await page.waitForSelector('[data-connection=lost]', { timeout: 5000 });
  console.log(`        noticed after ${((Date.now() - begin) / 1000).toFixed(1)} s`);
  ensure((await page.locator('.status').innerText()).includes('Reconnecting'), 'the line does not say so');
  await page.locator('.now h2', { hasText: 'Out of reach' }).waitFor({ timeout: 1000 });
  ensure(await connects, 'does not call again');  // though the old socket has not ended
  await wish('heart-lung');
  await row('heart-lung').filter({ hasText: 'sending' }).waitFor({ timeout: 2000 });
  ensure(!(await told()).includes('Coming!'), `promised what nobody has heard: ${await told()}`);
  ensure((await told()).includes('No connection'), `does not say that the wish waits: ${await told()}`);
  ensure(line.swallowed > 0, 'nothing was swallowed');
});

await check('the line comes back, and every wish arrives once', async () => {
  line.mend();
  await page.waitForSelector('[data-connection=open]', { timeout: 15000 });
  for (const target of ['zuse', 'heart-lung']) {
    await page.locator(`.queue li.mine[data-target=${target}]:not([data-state=sending]):not([data-state=waiting])`).first().waitFor({ timeout: 6000 });
  }
  await until('the promise', async () => (await told()).includes('Coming!'), 3000);
  await pause(3500); // time enough to say it twice
  const times = await page.evaluate(() => new Promise((resolve) => {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type !== 'board') return;
      socket.close();
      resolve([...message.open, ...message.closed].map((entry) => entry.target).sort().join(' '));
    };
  }));
  ensure(times === 'cyclotron heart-lung zuse', `on the board: ${times}`);
  await page.locator('.now[data-phase=driving], .now[data-phase=explaining], .now[data-phase=asking]').waitFor({ timeout: 5000 });
});

await check('nothing complains', async () => {
  const real = complaints.filter((text) => !/WebSocket|ERR_/.test(text));
  ensure(real.length === 0, real.join('; '));
});

await finish();
