// The face: what the robot feels can be seen, read and is never too much of it.
import { join } from 'node:path';
import { check, ensure, finish, pause, pictures, root, until } from './harness.mjs';
import { axeSays, listen, play } from './stage.mjs';

const stage = await play(join(root, 'museums', 'bonn'));
const { page, robot, complaints, hosts, context } = await listen({ viewport: { width: 1280, height: 800 }, isSmooth: true });
const face = page.locator('svg.drawn-face');
const expression = (valence, more = {}) =>
  robot.say({ type: 'expression', mood: valence > 0.3 ? 'happy' : valence < -0.3 ? 'angry' : 'neutral', valence, is_speaking: false, gaze: 'none', pan: 0, tilt: 0, ...more });
const path = (selector) => page.locator(selector).first().getAttribute('d');
/** Pairs of numbers of a path. */
const points = (text) => [...text.matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map((match) => [Number(match[1]), Number(match[2])]);
const smile = async () => {
  const [corner, , , below] = points(await path('.mouth'));
  return below[1] - corner[1];
};
/** How many different values `read` gives within `ms`. */
async function changes(read, ms) {
  const seen = new Set();
  for (const end = Date.now() + ms; Date.now() < end; ) seen.add(await read());
  return seen.size;
}

await check('the robot shows what it feels', async () => {
  await page.goto(`${stage.url}/face`);
  await page.waitForSelector('main[data-connection=open]');
  await until('the happy face of the robot', async () => Number(await face.getAttribute('data-valence')) > 0.5, 20000);
  ensure((await face.getAttribute('aria-label')) === 'a happy face', await face.getAttribute('aria-label'));
});

await check('from angry to happy, and looked at', async () => {
  const smiles = [];
  for (const valence of [-1, -0.5, 0, 0.5, 1]) {
    expression(valence);
    await pause(1200);
    smiles.push(await smile());
    await page.screenshot({ path: join(pictures, `face-${valence}.png`) });
    const found = await axeSays(page);
    ensure(found.length === 0, `${valence}: ${found.join('\n')}`);
  }
  for (let i = 1; i < smiles.length; ++i) ensure(smiles[i] > smiles[i - 1], `smiles ${smiles.map((s) => s.toFixed(1))}`);
  ensure(smiles[0] < -10 && smiles[4] > 10, `smiles ${smiles}`);
  expression(-0.4, { mood: 'sad' });
  await pause(1200);
  await page.screenshot({ path: join(pictures, 'face-sad.png') });
  ensure((await face.getAttribute('aria-label')) === 'a sad face', 'the sad face has another name');
});

await check('it looks left and up', async () => {
  expression(0.5);
  await pause(1000);
  const [x, y] = [Number(await page.locator('.pupil').first().getAttribute('cx')), Number(await page.locator('.pupil').first().getAttribute('cy'))];
  expression(0.5, { pan: 0.7, tilt: 0.4 });
  await pause(1000);
  await page.screenshot({ path: join(pictures, 'face-looks.png') });
  ensure(Number(await page.locator('.pupil').first().getAttribute('cx')) > x + 5, 'its left is our right');
  ensure(Number(await page.locator('.pupil').first().getAttribute('cy')) < y - 4, 'up is up');
});

await check('its mouth moves while it speaks, and it blinks', async () => {
  expression(0.5);
  await pause(1500);
  ensure((await changes(() => path('.mouth'), 800)) <= 2, 'the mouth of a silent robot moves');
  expression(0.5, { is_speaking: true });
  ensure((await changes(() => path('.mouth'), 1500)) > 10, 'the mouth of a speaking robot rests');
  await page.screenshot({ path: join(pictures, 'face-speaks.png') });
  expression(0.5);
  await until('a blink', async () => points(await path('.lid'))[2][1] > -20, 12000, 20);
});

await check('a reader who wants no motion gets none', async () => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.reload();
  await page.waitForSelector('main[data-connection=open]');
  expression(0.8, { is_speaking: true });
  await pause(500);
  ensure((await changes(() => path('.mouth'), 1500)) === 1, 'the mouth moves');
  ensure((await changes(() => path('.lid'), 5000)) === 1, 'it blinks');
  expression(-0.8);
  await until('the angry face', async () => (await smile()) < -8, 2000);
  await page.emulateMedia({ reducedMotion: 'no-preference' });
});

await check('tall, wide and small screens', async () => {
  expression(0.8);
  for (const [width, height] of [[1080, 1920], [1920, 1080], [480, 320]]) {
    await page.setViewportSize({ width, height });
    await pause(400);
    const box = await page.locator('.white').first().boundingBox();
    const mouth = await page.locator('.mouth').boundingBox();
    ensure(box.x > 0 && mouth.y + mouth.height < height, `${width} px: the face does not fit`);
    ensure(mouth.width > Math.min(width, height) * 0.2, `${width} px: the mouth is ${mouth.width} px wide`);
    await page.screenshot({ path: join(pictures, `face-${width}x${height}.png`) });
  }
});

/** Where the yellow of a happy face lies on a canvas: how many pixels, and their mean column as a share of its width. */
const yellow = (selector) =>
  page.evaluate((selector) => {
    const canvas = document.querySelector(selector);
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let [count, sum] = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 250 || Math.abs(data[i] - 255) > 8 || Math.abs(data[i + 1] - 214) > 14 || Math.abs(data[i + 2] - 92) > 20) continue;
      ++count;
      sum += ((i / 4) % canvas.width) / canvas.width;
    }
    return { count, x: count > 0 ? sum / count : 0 };
  }, selector);

await check('the robot on the visitors\' page shows the same mood and gaze', async () => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.goto(`${stage.url}/`);
  await page.waitForSelector('.map[data-localized=true]', { timeout: 20000 });
  for (const isDark of [false, true]) {
    for (const canvas of ['canvas.face', 'canvas.robot']) {
      expression(1);
      await until(`${canvas} is happy`, async () => (await yellow(canvas)).count > 25, 3000);
      expression(-1);
      await until(`${canvas} is angry`, async () => (await yellow(canvas)).count === 0, 3000);
    }
    await page.screenshot({ path: join(pictures, `page-angry-${isDark ? 'dark' : 'light'}.png`) });
    await page.getByRole('button', { name: 'Light or dark' }).click();
  }
  expression(1, { pan: 0.7 });
  await pause(1000);
  const left = await yellow('canvas.face');
  await page.screenshot({ path: join(pictures, 'page-happy.png') });
  expression(1, { pan: -0.7 });
  await pause(1000);
  const right = await yellow('canvas.face');
  ensure(left.x > right.x + 0.1, `its left is our right: ${left.x.toFixed(2)} and ${right.x.toFixed(2)}`);
  await page.goto(`${stage.url}/face`);
  await page.waitForSelector('main[data-connection=open]');
});

await check('without a line it is pale and calm', async () => {
  await stage.stage.stop();
  await page.waitForSelector('main.away', { timeout: 6000 });
  ensure((await face.getAttribute('data-valence')) === '0', 'it keeps a mood that nobody knows');
});

await check('nothing is fetched from elsewhere, and nothing complains', async () => {
  ensure([...hosts].every((host) => host === `127.0.0.1:${stage.port}`), [...hosts].join(', '));
  const real = complaints.filter((text) => !/ERR_CONNECTION_REFUSED|WebSocket/.test(text));
  ensure(real.length === 0, real.join('; '));
});

await context.close();
await finish();
