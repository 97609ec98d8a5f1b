// The whole robot in the simulated museum: a visitor on the page asks for an exhibit, and the robot is really there.
// What counts as "there" is the truth channel of the recording, never the robot's own opinion.
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { browse, build, check, ensure, finish, freePort, pause, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { readRecording } from './recording.mjs';

const NEAR = 0.5; // [m]
const port = process.env.DOCENT_TEST_PORT ?? String(await freePort());
const domain = process.env.DOCENT_TEST_DOMAIN ?? '60';
const url = `http://127.0.0.1:${port}/`;
const folder = temporaryFolder('tour');
const file = join(folder, 'tour.mcap');
const docent = join(build, 'bin', 'docent');

const robot = start(docent, [
  'up', '--sim', '--museum', join(root, 'museums', 'bonn'), '--crowd', 'quiet', '--port', port, '--domain', domain,
  '--state', join(folder, 'state'), '--record', file,
]);
const { page, complaints } = await browse();
let museum;
let exhibit;

const isUp = await check('docent up --sim opens the page', async () => {
  await until('the page answers', async () => {
    ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
    return fetch(url).then((reply) => reply.ok, () => false);
  }, 60000);
  museum = await (await fetch(`${url}api/museum.json`)).json();
  await page.goto(url);
  await page.waitForSelector('.map[data-ready=true]');
  await page.waitForSelector('[data-connection=open]');
});
if (!isUp) await finish();  // the rest would only wait

await check('the belief is shown while the robot finds itself', async () => {
  await page.waitForSelector('.map[data-localized=true], .local canvas', { timeout: 60000 });
  await pause(2000);
  await page.screenshot({ path: join(pictures, 'tour-waking.png') });
  await page.waitForSelector('.map[data-localized=true]', { timeout: 300000 });
  await page.screenshot({ path: join(pictures, 'tour-localized.png') });
});

await check('a click on an exhibit is queued', async () => {
  // The nearest one that is not at its feet: the test shall see a drive, not wait for a long one.
  const pose = await page.evaluate(() => new Promise((resolve) => {
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      if (message.type === 'live' && message.pose) {
        socket.close();
        resolve(message.pose);
      }
    };
  }));
  const far = (one) => Math.hypot(one.pose[0] - pose[0], one.pose[1] - pose[1]);
  const choices = museum.exhibits.filter((one) => far(one) > 4).sort((a, b) => far(a) - far(b));
  exhibit = choices[0];
  ensure(exhibit, 'no exhibit further than 4 m away');
  await page.click(`[data-exhibit="${exhibit.id}"]`);
  await page.fill('.who input', 'Emmy');
  await page.click('.go');
  await page.locator(`.queue li.mine[data-target="${exhibit.id}"]:not([data-state=sending]):not([data-state=waiting])`).waitFor({ timeout: 10000 });
});

await check('it is reached and explained', async () => {
  await page.waitForSelector('.now[data-phase=driving]', { timeout: 120000 });
  await pause(4000);
  await page.screenshot({ path: join(pictures, 'tour-driving.png') });
  await page.locator(`.exhibit.goal[data-exhibit="${exhibit.id}"]`).waitFor({ timeout: 300000 });
  await until('the robot explains it', () =>
    page.evaluate((id) => document.querySelector('.now')?.dataset.phase === 'explaining' && !!document.querySelector(`.exhibit.goal[data-exhibit="${id}"]`), exhibit.id), 420000, 250);
  await page.locator('.story .saying').first().waitFor({ timeout: 20000 });
  await pause(1500);
  await page.screenshot({ path: join(pictures, 'tour-explaining.png') });
  await page.locator(`.queue li.done.mine[data-target="${exhibit.id}"][data-state=fulfilled]`).waitFor({ timeout: 240000 });
  await page.screenshot({ path: join(pictures, 'tour-done.png') });
});

await check('nothing on the page complained', async () => {
  ensure(complaints.length === 0, complaints.join('; '));
});

await page.context().close();
await robot.stop('SIGINT');

await check(`the truth in the recording: within ${NEAR} m of the exhibit while it was explained`, async () => {
  ensure(existsSync(file), `no recording; ${folder} has ${readdirSync(folder).join(', ')}`);
  const [x, y] = exhibit.pose;
  let explaining = false;
  let samples = 0;
  let worst = 0;
  readRecording(file, ['truth/state', 'docent/mission_state'], (topic, message) => {
    if (topic === 'docent/mission_state') {
      explaining = message.phase === 'explaining' && message.exhibit_id === exhibit.id;
    } else if (explaining) {
      ++samples;
      worst = Math.max(worst, Math.hypot(message.x - x, message.y - y));
    }
  });
  ensure(samples > 10, `only ${samples} samples of the truth while it explained`);
  ensure(worst <= NEAR, `it stood ${worst.toFixed(2)} m from where ${exhibit.id} is shown`);
  console.log(`        ${exhibit.id}: at most ${worst.toFixed(3)} m off in ${samples} samples`);
});

await finish();
