// One journey through the whole robot, in few processor seconds: a visitor sees it on the page, clicks an exhibit and is
// guided there; an operator stops it and lets it go. What counts as "there" is the truth channel of the recording.
import { spawnSync } from 'node:child_process';
import { cpSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { browse, build, check, ensure, finish, freePort, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { readRecording } from './recording.mjs';
import { axeSays } from './stage.mjs';

const NEAR = 0.5; // [m]
const CONTACT_SPEED = 0.1; // [m/s]
const PASSWORD = 'a long way from Bonn';
const docent = join(build, 'bin', 'docent');
const folder = temporaryFolder('journey');
const state = join(folder, 'state');
const file = join(folder, 'journey.mcap');
// The hall with short texts.
const museum = join(folder, 'bonn');
cpSync(join(root, 'museums', 'bonn'), museum, { recursive: true });
for (const name of readdirSync(join(museum, 'content'))) {
  if (name.endsWith('.md')) writeFileSync(join(museum, 'content', name), 'Here stands something that is worth a look. Many people have worked on it for years.\n');
}
const [, x, y, heading] = readFileSync(join(museum, 'museum.yaml'), 'utf8').match(/^home: \{x: ([\d.-]+), y: ([\d.-]+), heading: ([\d.-]+)\}/m);
const made = spawnSync(docent, ['web-account', 'add', 'ada', '--role', 'operator', '--state', state], { input: `${PASSWORD}\n`, encoding: 'utf8' });
ensure(made.status === 0, made.stderr);

const port = String(await freePort());
const url = `http://127.0.0.1:${port}/`;
const robot = start(docent, [
  'up', '--sim', '--museum', museum, '--crowd', 'quiet', '--requests-per-hour', '0', '--no-cameras', '--port', port,
  '--domain', process.env.DOCENT_TEST_DOMAIN ?? '67', '--state', state, '--record', file, `--start=${x},${y},${heading}`,
]);
const { page, complaints } = await browse();
let survey;
let exhibit;

const isUp = await check('the page shows the robot in its museum', async () => {
  await until('the page answers', async () => {
    ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
    return fetch(url).then((reply) => reply.ok, () => false);
  }, 60000);
  survey = await (await fetch(`${url}api/museum.json`)).json();
  await page.goto(url);
  await page.waitForSelector('.map[data-ready=true]');
  await page.waitForSelector('[data-connection=open]');
  ensure((await page.locator('[data-exhibit]').count()) === survey.exhibits.length, 'exhibits are missing');
  await page.waitForSelector('.map[data-localized=true]', { timeout: 120000 });
  await until('the robot is drawn', () => page.locator('canvas.robot').isVisible());
});
if (!isUp) await finish(); // the rest would only wait

await check('the visitors’ page is accessible', async () => {
  const found = await axeSays(page);
  ensure(found.length === 0, found.join('\n').slice(0, 1500));
});

await check('a click on an exhibit is queued, and the robot sets out', async () => {
  const far = (one) => Math.hypot(one.pose[0] - x, one.pose[1] - y);
  exhibit = survey.exhibits.filter((one) => far(one) > 4).sort((a, b) => far(a) - far(b))[0];
  await page.click(`[data-exhibit="${exhibit.id}"]`);
  await page.fill('.who input', 'Emmy');
  await page.click('.go');
  await page.locator(`.queue li.mine[data-target="${exhibit.id}"]:not([data-state=sending]):not([data-state=waiting])`).waitFor({ timeout: 10000 });
  await page.waitForSelector('.now[data-phase=driving]', { timeout: 60000 });
});

const operator = await browse({ viewport: { width: 1280, height: 900 } });
await check('an operator stops it on its way, and lets it go', async () => {
  const { page: desk } = operator;
  await desk.goto(`${url}operate`);
  await desk.waitForSelector('.login[data-rank=viewer]');
  ensure((await desk.locator('.stop-button').count()) === 0, 'a stop button for anybody');
  await desk.locator('.login input').first().fill('ada');
  await desk.locator('.login input[type=password]').fill(PASSWORD);
  await desk.locator('.login button[type=submit]').click();
  await desk.waitForSelector('.stop[data-open=true]');
  await desk.evaluate(() => {
    window.heard = { v: 1, reason: '' };
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type === 'live') window.heard = { v: message.v, reason: message.avoid?.reason?.word ?? '' };
    };
  });
  const robotDoes = (what, condition, patience) => until(what, async () => condition(await desk.evaluate(() => window.heard)), patience, 50);
  await robotDoes('it drives', (now) => now.v > 0.1, 60000);
  await desk.locator('.stop-button').click();
  await desk.waitForSelector('.stop[data-stopped=true]');
  await robotDoes('it stands', (now) => now.reason === 'stopped_by_hand' && Math.abs(now.v) < 0.02, 5000);
  const found = await axeSays(desk);
  ensure(found.length === 0, found.join('\n').slice(0, 1500));
  await desk.screenshot({ path: join(pictures, 'journey-stopped.png') });
  await desk.locator('.stop button.plain').click();
  await desk.waitForSelector('.stop[data-stopped=false]');
  await robotDoes('it drives again', (now) => now.v > 0.1, 20000);
});
await operator.context.close();

await check('the visitor is guided to the exhibit, hears of it, and the wish has come true', async () => {
  await until('the robot explains it', () =>
    page.evaluate((id) => document.querySelector('.now')?.dataset.phase === 'explaining' && !!document.querySelector(`.exhibit.goal[data-exhibit="${id}"]`), exhibit.id), 240000, 250);
  await page.locator('.story .saying').first().waitFor({ timeout: 20000 });
  await page.screenshot({ path: join(pictures, 'journey-explaining.png') });
  await page.locator(`.queue li.done.mine[data-target="${exhibit.id}"][data-state=fulfilled]`).waitFor({ timeout: 120000 });
});

await check('nothing on the pages complained', async () => {
  const all = complaints.concat(operator.complaints);
  ensure(all.length === 0, all.join('; '));
});

await page.context().close();
await robot.stop('SIGINT');

await check(`the truth in the recording: within ${NEAR} m of the exhibit while it was explained, and nothing touched`, async () => {
  let explaining = false;
  let samples = 0;
  let worst = 0;
  let contacts = 0;
  readRecording(file, ['truth/state', 'truth/contact', 'docent/mission_state'], (topic, message) => {
    if (topic === 'docent/mission_state') {
      explaining = message.phase === 'explaining' && message.exhibit_id === exhibit.id;
    } else if (topic === 'truth/contact') {
      // Who walks into a robot that stands or has braked in time was not touched by it (src/docent/evaluation).
      const isBump = message.kind === 'people' && (message.robot_speed <= CONTACT_SPEED || (message.braked_in_time && message.other_speed > message.robot_speed));
      if (!isBump) ++contacts;
    } else if (explaining) {
      ++samples;
      worst = Math.max(worst, Math.hypot(message.x - exhibit.pose[0], message.y - exhibit.pose[1]));
    }
  });
  ensure(samples > 10, `only ${samples} samples of the truth while it explained`);
  ensure(worst <= NEAR, `it stood ${worst.toFixed(2)} m from where ${exhibit.id} is shown`);
  ensure(contacts === 0, `${contacts} contacts`);
  console.log(`        ${exhibit.id}: at most ${worst.toFixed(3)} m off in ${samples} samples`);
});

await finish();
