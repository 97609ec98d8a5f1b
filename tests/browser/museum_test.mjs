// The museum editor, with the whole robot in the simulated museum: draw a hazard across the robot's way and see it drive
// round; what cannot work, and what must not be done while it drives; publish, and see what stands in the folder.
import { spawnSync } from 'node:child_process';
import { cpSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { browse, build, check, editorMap, ensure, finish, freePort, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { axeSays } from './stage.mjs';

const docent = join(build, 'bin', 'docent');
const state = temporaryFolder('museum-state');
const museum = join(temporaryFolder('museum'), 'bonn');
cpSync(join(root, 'museums', 'bonn'), museum, { recursive: true });
const PASSWORD = 'a long way from Bonn';
const made = spawnSync(docent, ['web-account', 'add', 'ada', '--role', 'operator', '--state', state], { input: `${PASSWORD}\n`, encoding: 'utf8' });
ensure(made.status === 0, made.stderr);
const port = String(await freePort());
const robot = start(docent, [
  'up', '--sim', '--museum', museum, '--crowd', 'empty', '--requests-per-hour', '0', '--no-cameras', '--port', port,
  '--domain', process.env.DOCENT_TEST_DOMAIN ?? '66', '--state', state,
]);
const url = `http://127.0.0.1:${port}/`;
const answers = () => fetch(`${url}api/museum.json`).then((reply) => reply.json(), () => null);
await until('the page answers', async () => {
  ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
  return answers();
}, 60000);

/** Where the robot says that it is, and where it wants to go, on a connection of the test's own that comes back. */
const watcher = await browse();
await watcher.page.goto(`${url}metrics`);
await watcher.page.evaluate(() => {
  window.heard = { poses: [], path: [], v: 0, seen: 0 };
  const connect = () => {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onopen = () => socket.send(JSON.stringify({ type: 'watch', details: true, thin: false }));
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type === 'path') window.heard.path = message.points;
      if (message.type !== 'live') return;
      window.heard.v = message.v;
      window.heard.seen = Date.now();
      if (message.pose) window.heard.poses.push(message.pose);
    };
    socket.onclose = () => setTimeout(connect, 300);
  };
  connect();
});
const heard = () => watcher.page.evaluate(() => window.heard);
const forget = () => watcher.page.evaluate(() => void (window.heard = { poses: [], path: [], v: 0, seen: 0 }));

const operator = await browse({ viewport: { width: 1360, height: 900 } });
const { page, complaints } = operator;
await page.goto(`${url}operate`);
await page.waitForSelector('.login[data-rank=viewer]');
await page.locator('.login input').first().fill('ada');
await page.locator('.login input[type=password]').fill(PASSWORD);
await page.locator('.login button[type=submit]').click();
await page.waitForSelector('.stop[data-open=true]');
await page.waitForSelector('.map[data-localized=true]', { timeout: 300000 });

const { onPage, click } = editorMap(page);
async function drag(from, to) {
  const [a, b] = [await onPage(from), await onPage(to)];
  await page.mouse.move(...a);
  await page.mouse.down();
  await page.mouse.move(...b, { steps: 6 });
  await page.mouse.up();
}
const card = (condition) => page.waitForSelector(`.museum-card${condition}`, { timeout: 60000 });
const isInside = ([x, y], corners) => {
  let inside = false;
  for (let i = 0, k = corners.length - 1; i < corners.length; k = i++) {
    const [[ax, ay], [bx, by]] = [corners[i], corners[k]];
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
};

const GOAL = 'zeolite';
const known = await answers();
const goal = known.exhibits.find(({ id }) => id === GOAL);
/** Where the robot has to be able to stand. */
const standing = [known.home, known.charger, ...known.exhibits.flatMap(({ pose, viewpoints }) => [pose, ...viewpoints]), ...known.rooms.map(({ at }) => at)];
let hazard = [];
await check('the robot is on its way to an exhibit, and is stopped', async () => {
  const id = '01900000-0000-7000-8000-00000000000a';
  await watcher.page.evaluate(([exhibit, wish]) => {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onopen = () => socket.send(JSON.stringify({ type: 'request', id: wish, kind: 'exhibit', target: exhibit, viewpoint: -1, name: 'Ada', language: 'en' }));
  }, [GOAL, id]);
  await until('it drives', async () => (await heard()).v > 0.2 && (await heard()).path.length > 8, 60000);
  await page.locator('.stop-button').click();
  await page.waitForSelector('.stop[data-stopped=true]');
  await until('it stands', async () => Math.abs((await heard()).v) < 0.02);
});
await check('the value function and what stands there now lie over the map when they are asked for', async () => {
  await page.waitForSelector('.maps[data-value=true][data-live=true]', { timeout: 15000 });
  const colours = () => page.evaluate(() => {
    const canvas = document.querySelector('.map canvas');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let warm = 0;
    for (let i = 0; i < data.length; i += 4) if (data[i] > 150 && data[i + 2] < 110) ++warm;
    return warm;
  });
  const before = await colours();
  await page.locator('.maps [name=value]').check();
  await page.locator('.maps [name=live]').check();
  await until('the map is coloured', async () => (await colours()) > before + 5000);
  await page.screenshot({ path: join(pictures, 'museum-maps.png') });
  await page.locator('.maps [name=value]').uncheck();
  await page.locator('.maps [name=live]').uncheck();
});
await check('nothing is tried or published while the robot may drive; the editor says so', async () => {
  const refused = await page.evaluate(async () => {
    const me = await (await fetch('/api/v1/login')).json();
    const { revision, draft } = await (await fetch('/api/v1/museum')).json();
    window.before = { me, revision, draft };
    return revision.length;
  });
  ensure(refused === 16, `revision of ${refused} digits`);
  await page.locator('.stop button.plain').click();
  await page.waitForSelector('.stop[data-stopped=false]');
  const said = await page.evaluate(async () => {
    const { me, revision, draft } = window.before;
    const reply = await fetch('/api/v1/museum/trial', {
      method: 'PUT', headers: { 'Content-Type': 'application/json', 'Docent-Csrf': me.csrf }, body: JSON.stringify({ revision, draft }),
    });
    return `${reply.status} ${(await reply.json()).reason}`;
  });
  ensure(said === '409 must_stand', said);
  await page.locator('.stop-button').click();
  await page.waitForSelector('.stop[data-stopped=true]');
  await until('it stands', async () => Math.abs((await heard()).v) < 0.02);
  complaints.length = 0; // the browser complains of 409
});
await check('a hazard is drawn across the way', async () => {
  await page.locator('.edit-museum').click();
  await card('[data-busy=false]');
  const { path, poses } = await heard();
  const [x, y] = poses.at(-1);
  // Three metres on along the way, where nobody has to stand.
  const points = [];
  for (let i = 0; i + 1 < path.length; i += 2) points.push([path[i], path[i + 1]]);
  const far = points.filter((point) => Math.hypot(point[0] - x, point[1] - y) > 3 && standing.every((place) => Math.hypot(point[0] - place[0], point[1] - place[1]) > 1.4));
  const middle = far[0];
  ensure(middle, `a way of ${points.length} points`);
  hazard = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(([dx, dy]) => [middle[0] + dx, middle[1] + dy]);
  ensure(points.some((point) => isInside(point, hazard)), 'the way that it wanted does not cross it');
  await page.locator('.editor-tools [data-tool=hazard]').click();
  for (const corner of hazard) await click(corner);
  await page.screenshot({ path: join(pictures, 'museum-drawing.png') });
  await click(hazard[0]);
  await page.waitForSelector('[data-hazard=hazard-1]');
  await card('[data-changed=true]');
  await page.locator('.editor-form [name=id]').fill('puddle');
  await page.locator('.editor-form [name=id]').blur();
  await page.waitForSelector('[data-hazard=puddle]');
  await page.screenshot({ path: join(pictures, 'museum-drawn.png') });
});
await check('corners are dragged and split, by the keyboard too, and every step is taken back', async () => {
  const corners = () => page.locator('[data-hazard=puddle]').getAttribute('points');
  const before = await corners();
  const [x, y] = hazard[2];
  await drag(hazard[2], [x + 0.4, y + 0.3]);
  const dragged = await corners();
  ensure(dragged !== before, 'the corner did not move');
  await page.locator('[data-handle="middle:0"]').focus();
  await page.keyboard.press('ArrowDown');
  ensure((await corners()).split(' ').length === 5, await corners());
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  ensure((await corners()) === before, `${await corners()} is not ${before}`);
});
await check('what cannot work is named, and is not tried', async () => {
  // The place where the robot waits, moved into the hazard.
  await page.locator('.editor-list button', { hasText: 'Where it waits' }).click();
  const home = (await answers()).home;
  await drag([home[0], home[1]], [(hazard[0][0] + hazard[2][0]) / 2, (hazard[0][1] + hazard[2][1]) / 2]);
  await page.locator('[data-do=check]').click();
  await page.waitForSelector('.museum-card .faults', { timeout: 30000 });
  const text = await page.locator('.museum-card .faults').innerText();
  ensure(text.includes('home') && text.includes('puddle'), text);
  await page.screenshot({ path: join(pictures, 'museum-faults.png') });
  await page.locator('[data-do=try]').click();
  await card('[data-busy=false][data-trial=false]');
  ensure((await page.locator('.museum-card .faults').count()) === 1, 'it was tried');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Control+z');
  await page.locator('[data-do=check]').click();
  await until('no fault is left', () => page.evaluate(() => document.querySelector('.museum-state').textContent.includes('No fault')), 30000);
  ensure((await axeSays(page)).length === 0, JSON.stringify(await axeSays(page)));
});
await check('the robot tries the draft, stays stopped, and drives round the hazard', async () => {
  await page.locator('[data-do=try]').click();
  await card('[data-trial=true][data-busy=false]');
  await page.waitForSelector('.stop[data-open=true][data-stopped=true]', { timeout: 30000 });
  ensure((await answers()).hazards.some(({ id }) => id === 'puddle'), 'the page does not know of it');
  ensure(!readFileSync(join(museum, 'museum.yaml'), 'utf8').includes('puddle'), 'a trial was published');
  await forget();
  await until('it knows where it is', async () => (await heard()).poses.length > 3, 120000);
  await page.locator('.stop button.plain').click();
  await page.waitForSelector('.stop[data-stopped=false]');
  await until('it arrives', async () => {
    const { poses } = await heard();
    const [x, y] = poses.at(-1);
    return Math.hypot(x - goal.pose[0], y - goal.pose[1]) < 0.6;
  }, 180000, 500);
  const { poses } = await heard();
  const clearance = Math.min(...poses.map((pose) => distanceTo(pose, hazard)));
  ensure(clearance > 0.265, `its centre came within ${clearance.toFixed(2)} m of the hazard`);
  console.log(`  ${poses.length} poses on the way, the nearest ${clearance.toFixed(2)} m from the hazard`);
  await page.screenshot({ path: join(pictures, 'museum-trial.png') });
});
function distanceTo([x, y], corners) {
  if (isInside([x, y], corners)) return 0;
  let least = Infinity;
  corners.forEach(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    const share = Math.max(0, Math.min(1, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2)));
    least = Math.min(least, Math.hypot(x - ax - share * (bx - ax), y - ay - share * (by - ay)));
  });
  return least;
}
await check('what is published stands in the museum’s folder, with its comments', async () => {
  await page.locator('.stop-button').click();
  await page.waitForSelector('.stop[data-stopped=true]');
  await page.locator('[data-do=publish]').click();
  await card('[data-trial=false][data-busy=false]');
  await until('it is published', () => page.evaluate(() => document.querySelector('.museum-state').textContent.includes('Published')), 30000);
  const yaml = readFileSync(join(museum, 'museum.yaml'), 'utf8');
  ensure(/\n {2}- \{id: puddle, kind: other, polygon: /.test(yaml), yaml.slice(0, 2000));
  ensure(yaml.startsWith('# museum.yaml'), 'its comments are gone');
  ensure(readFileSync(join(museum, 'museum.yaml.before'), 'utf8') === readFileSync(join(root, 'museums', 'bonn', 'museum.yaml'), 'utf8'), 'what was before is not kept');
  await until('the museum is read again', async () => (await answers())?.hazards.some(({ id }) => id === 'puddle'), 30000);
});
await check('a new exhibit comes with its texts', async () => {
  await page.waitForSelector('.stop[data-open=true]', { timeout: 30000 });
  await page.locator('.editor-tools [data-tool=exhibit]').click();
  // Where nothing stands, the new hazard neither.
  const place = [[10.5, 7.5], [13.5, 5.5], [12, 3.5], [19, 14.5]].find(([x, y]) => Math.hypot(x - hazard[0][0], y - hazard[0][1]) > 3 && distanceTo([x, y - 1], hazard) > 1.5);
  await click(place);
  await page.locator('.editor-form [name=title-en]').fill('A new thing');
  await page.locator('.editor-form [name=short-en]').fill('Nobody has seen it before.');
  await page.locator('.editor-form [name=short-de]').fill('Niemand hat es je gesehen.');
  await page.locator('.editor-form [name=short-de]').blur();
  await page.locator('[data-do=publish]').click();
  await card('[data-busy=true]').catch(() => undefined);
  await card('[data-trial=false][data-busy=false]');
  const faults = await page.locator('.museum-card .faults').allInnerTexts();
  ensure(faults.length === 0, faults.join());
  await until('visitors see it', async () => (await answers())?.exhibits.some(({ title }) => title.en === 'A new thing'), 30000);
  ensure(readFileSync(join(museum, 'content', 'exhibit-1.short.de.md'), 'utf8') === 'Niemand hat es je gesehen.\n', 'its text');
  await page.screenshot({ path: join(pictures, 'museum-exhibit.png') });
});
await check('the editor works on a phone', async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForSelector('.editor-map svg');
  await page.screenshot({ path: join(pictures, 'museum-phone.png') });
  const sideways = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  ensure(!sideways, 'the page is wider than the phone');
});
await finish();
