// What visitors on the Web do together, with the whole robot: send it anywhere in their hours, and vote for tours.
import { join } from 'node:path';
import { browse, build, check, ensure, finish, freePort, pictures, root, start, temporaryFolder, until } from './harness.mjs';

const NEAR = 0.5; // [m]
const docent = join(build, 'bin', 'docent');
const folder = temporaryFolder('together');

/** A robot in the museum of Bonn, without visitors in the hall. */
async function robotIn(mode, domain, settings = []) {
  const port = String(await freePort());
  const robot = start(docent, [
    'up', '--sim', '--museum', join(root, 'museums', 'bonn'), '--crowd', 'quiet', '--requests-per-hour', '0', '--mode', mode, '--port', port,
    '--domain', domain, '--state', join(folder, mode), ...settings.flatMap((setting) => ['--set', setting]),
  ]);
  const url = `http://127.0.0.1:${port}/`;
  await until('the page answers', async () => {
    ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
    return fetch(url).then((reply) => reply.ok, () => false);
  }, 60000);
  return { robot, url };
}
async function visit(url, options) {
  const browser = await browse(options);
  await browser.page.goto(url);
  await browser.page.waitForSelector('.map[data-ready=true]');
  await browser.page.waitForSelector('[data-connection=open]');
  return browser;
}
const poseOf = (page) => page.evaluate(() => new Promise((resolve) => {
  const socket = new WebSocket(`ws://${location.host}/live`);
  socket.onmessage = (event) => {
    const message = JSON.parse(event.data);
    if (message.type !== 'live' || !message.pose) return;
    socket.close();
    resolve(message.pose);
  };
}));
/** Where a place of the map is on the page [px]: two markers tell. */
const pixelsOf = (page, museum, [x, y]) => page.evaluate(([a, b, x, y]) => {
  const at = (id) => {
    const [left, top] = document.querySelector(`[data-exhibit="${id}"]`).style.transform.match(/-?[\d.]+/g).map(Number);
    return [left, top];
  };
  const [pa, pb] = [at(a.id), at(b.id)];
  const scale = (pb[0] - pa[0]) / (b.look_at[0] - a.look_at[0]);
  const box = document.querySelector('.map canvas').getBoundingClientRect();
  const point = [box.left + pa[0] + (x - a.look_at[0]) * scale, box.top + pa[1] - (y - a.look_at[1]) * scale];
  return { point, isFloor: document.elementFromPoint(...point)?.matches('.map > canvas:first-child') ?? false };
}, [museum.exhibits[0], museum.exhibits.find((one) => Math.abs(one.look_at[0] - museum.exhibits[0].look_at[0]) > 4), x, y]);

// The hours of the Web -------------------------------------------------------------------------------------------

const first = await robotIn('web', process.env.DOCENT_TEST_DOMAIN ?? '62');
const museum = await (await fetch(`${first.url}api/museum.json`)).json();
const { page, complaints } = await visit(first.url);
let target;

await check('the page says that these are the hours of the Web', async () => {
  await page.waitForSelector('.web-hours');
  await page.waitForSelector('.map[data-localized=true]', { timeout: 300000 });
});

await check('a tap on the floor sends the robot there', async () => {
  const pose = await poseOf(page);
  const far = (one) => Math.hypot(one.pose[0] - pose[0], one.pose[1] - pose[1]);
  for (const one of museum.exhibits.filter((one) => far(one) > 2 && !one.web_only).sort((a, b) => far(a) - far(b))) {
    const { point, isFloor } = await pixelsOf(page, museum, one.pose);
    if (!isFloor) continue;
    await page.mouse.click(...point);
    target = one.pose;
    break;
  }
  ensure(target, 'no free place on the floor found');
  await page.screenshot({ path: join(pictures, 'together-point.png') });
  await page.locator('.pin-card .go').click();
  await page.waitForSelector('.queue li[data-state=active] b');
  await page.waitForSelector('.pin.mine');
  await page.screenshot({ path: join(pictures, 'together-on-its-way.png') });
  await until('it is there', async () => {
    const now = await poseOf(page);
    return Math.hypot(now[0] - target[0], now[1] - target[1]) < NEAR;
  }, 120000, 1000);
  await page.waitForSelector('.queue li.done[data-state=fulfilled]', { timeout: 90000 });
});

await check('the rooms have their names, and a tap on one sends the robot there', async () => {
  ensure((await page.locator('.room').count()) === museum.rooms.length && museum.rooms.length > 3, `${museum.rooms.length} rooms`);
  const pose = await poseOf(page);
  const far = (room) => Math.hypot(room.at[0] - pose[0], room.at[1] - pose[1]);
  const room = [...museum.rooms].sort((a, b) => far(a) - far(b)).find((one) => far(one) > 2);
  await page.locator(`button[data-room=${room.id}] span`).click();
  await page.screenshot({ path: join(pictures, 'together-room.png') });
  await page.locator('.pin-card .go').click();
  await page.waitForSelector(`.queue li[data-target=${room.id}][data-state=active]`);
  await until('it says so', async () => (await page.locator('.now').innerText()).includes(room.name.en.toLowerCase()) || (await page.locator('.now').innerText()).includes(room.name.en));
  await until('it is there', async () => {
    const now = await poseOf(page);
    return Math.hypot(now[0] - room.at[0], now[1] - room.at[1]) < NEAR;
  }, 120000, 1000);
  await page.waitForSelector(`.queue li.done[data-target=${room.id}][data-state=fulfilled]`, { timeout: 90000 });
});

await check('five places may be wished for at once, the sixth is refused with a reason', async () => {
  const answers = await page.evaluate((poses) => new Promise((resolve) => {
    const socket = new WebSocket(`ws://${location.host}/live`);
    const id = (i) => `018f3a6c-5b2e-7c3d-9a4b-00000000000${i}`;
    const seen = {};
    socket.onopen = () => poses.forEach(([x, y], i) => socket.send(JSON.stringify({
      type: 'request', id: id(i), kind: 'point', target: `${x.toFixed(2)},${y.toFixed(2)}`, name: 'Ada', language: 'en',
    })));
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type !== 'board') return;
      for (const entry of [...message.open, ...message.closed]) {
        const number = poses.findIndex((_, i) => id(i).endsWith(entry.key));
        if (number >= 0) seen[number] ??= [entry.state, entry.reason?.word ?? ''];
      }
      if (Object.keys(seen).length === poses.length) resolve(Object.values(seen));
    };
  }), museum.exhibits.slice(0, 6).map((one) => one.pose));
  ensure(answers.slice(0, 5).every(([state]) => state === 'active' || state === 'queued'), JSON.stringify(answers));
  ensure(answers[5].join() === 'refused,too_many_points', JSON.stringify(answers));
  await until('five pins', async () => (await page.locator('.pin').count()) === 5);
  await page.screenshot({ path: join(pictures, 'together-five.png') });
});
await check('the page of the Web\'s hours had nothing to complain of', () => ensure(complaints.length === 0, complaints.join('\n')));
await first.robot.stop();

// Votes ----------------------------------------------------------------------------------------------------------

const second = await robotIn('open', process.env.DOCENT_TEST_DOMAIN_2 ?? '63', ['mission.vote_idle_s=15', 'mission.mingles=false']);
const ada = await visit(second.url);
const grace = await visit(second.url, { viewport: { width: 390, height: 844 } });
const tour = museum.tours.find((one) => one.exhibits.length > 0).id;
const other = museum.tours.find((one) => one.id !== tour).id;
const count = (page, id) => page.locator(`[data-vote=${id}] span`).innerText();

await check('each vote counts on every page, and may be changed', async () => {
  await ada.page.locator(`[data-vote=${other}]`).click();
  await until('one vote', async () => (await count(grace.page, other)).includes('1'));
  await ada.page.locator(`[data-vote=${tour}]`).click();
  await grace.page.locator(`[data-vote=${tour}]`).click();
  await until('two votes', async () => (await count(ada.page, tour)).includes('2') && (await count(ada.page, other)).includes('0'));
  await ada.page.screenshot({ path: join(pictures, 'together-votes.png') });
  await grace.page.locator('.tours').scrollIntoViewIfNeeded();
  await grace.page.screenshot({ path: join(pictures, 'together-votes-phone.png') });
});

await check('the robot, which has nothing else to do, gives the tour with the most votes, and a new round begins', async () => {
  await ada.page.waitForSelector('.map[data-localized=true]', { timeout: 300000 });
  await ada.page.waitForSelector(`.queue li[data-target="${tour}"][data-state=active]`, { timeout: 120000 });
  await until('no votes', async () => (await count(ada.page, tour)).includes('0'));
  await ada.page.screenshot({ path: join(pictures, 'together-voted-tour.png') });
});
await check('the pages of the voters had nothing to complain of', () => {
  const all = [...ada.complaints, ...grace.complaints];
  ensure(all.length === 0, all.join('\n'));
});
await finish();
