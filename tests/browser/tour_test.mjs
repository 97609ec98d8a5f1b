// The whole robot in the simulated museum: a visitor on the page asks for an exhibit, and the robot is really there.
// What counts as "there" is the truth channel of the recording, never the robot's own opinion.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
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

/** Ids of the processes of one of the robot's modules. */
const processesOf = (module) =>
  execFileSync('ps', ['--ppid', String(robot.child.pid), '-o', 'pid=,args='], { encoding: 'utf8' })
    .split('\n')
    .filter((line) => new RegExp(` run ${module}( |$)`).test(line))
    .map((line) => Number(line.trim().split(/\s+/)[0]));

await check('the screen’s server and the buttons die at an open question: the tour goes on, the screen is right again', async () => {
  const { page: screen, context } = await browse({ viewport: { width: 1080, height: 1920 } });
  const shows = (name, patience) => screen.locator(`main[data-screen=${name}]`).waitFor({ timeout: patience });
  const served = async () => Number(await page.evaluate(() => document.querySelectorAll('.queue li.done[data-state=fulfilled]').length));
  await screen.goto(`${url}kiosk#${readFileSync(join(folder, 'state', 'screen.key'), 'utf8').trim()}`);
  await shows('home', 120000);
  const before = await served();
  await screen.keyboard.press('1');
  await shows('asking', 420000);
  const old = [...processesOf('web'), ...processesOf('buttons')];
  ensure(old.length === 2, `the processes are ${old.join(' ')}`);
  for (const id of old) process.kill(id, 'SIGKILL');
  await shows('away', 8000);
  // The question's five seconds are over by now, so the robot drives to the next exhibit or explains it.
  await screen.locator('main[data-screen=driving], main[data-screen=explaining], main[data-screen=blocked]').waitFor({ timeout: 60000 });
  await until('both have new processes', () => [...processesOf('web'), ...processesOf('buttons')].filter((id) => !old.includes(id)).length === 2, 20000);
  await screen.screenshot({ path: join(pictures, 'tour-kiosk-again.png') });
  await shows('asking', 420000);
  await screen.keyboard.press('4');
  await screen.locator('main[data-screen=driving], main[data-screen=answered]').waitFor({ timeout: 8000 });
  ensure((await served()) >= before, 'the page forgot what was served');
  await context.close();
});

await check('nothing on the page complained', async () => {
  // Its line broke while its server was dead.
  const others = complaints.filter((text) => !/WebSocket|ERR_CONNECTION/.test(text));
  ensure(others.length === 0, others.join('; '));
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
