// What both cameras see, at the rate that a viewer chooses, with the whole robot in the simulated museum.
import { join } from 'node:path';
import { browse, build, check, ensure, finish, freePort, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { axeSays } from './stage.mjs';

const docent = join(build, 'bin', 'docent');
const port = String(await freePort());
const robot = start(docent, [
  'up', '--sim', '--museum', join(root, 'museums', 'bonn'), '--crowd', 'busy', '--start=13,18.5,60', '--port', port,
  '--domain', process.env.DOCENT_TEST_DOMAIN ?? '64', '--state', temporaryFolder('cameras'),
]);
const url = `http://127.0.0.1:${port}/`;
await until('the page answers', async () => {
  ensure(robot.code === null, `docent up ended with ${robot.code}: ${robot.output.slice(-600)}`);
  return fetch(url).then((reply) => reply.ok, () => false);
}, 60000);
await until('a picture is there', () => fetch(`${url}camera/scene.jpg`).then((reply) => reply.status === 200, () => false), 60000);

const { page, complaints } = await browse({ viewport: { width: 1280, height: 900 } });
const asked = { robot: 0, scene: 0 };
page.on('response', (response) => {
  const name = response.url().match(/camera\/(\w+)\.jpg/)?.[1];
  if (name) asked[name]++;
});
await page.goto(url);
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const choose = (word) => page.locator('.cameras select').selectOption({ label: word });
/** Pictures of each camera that come within a time [s]. */
async function count(seconds) {
  const before = { ...asked };
  await wait(seconds * 1000);
  return Math.max(asked.robot - before.robot, asked.scene - before.scene);
}

await check('both cameras are shown, with the age of their pictures', async () => {
  await page.waitForSelector('.cameras figure:nth-child(2) img');
  const seen = await page.evaluate(async () => {
    const result = [];
    for (const image of document.querySelectorAll('.cameras img')) {
      await image.decode();
      const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const data = context.getImageData(0, 0, canvas.width, canvas.height).data;
      const colors = new Set();
      for (let i = 0; i < data.length; i += 4) colors.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
      result.push({ width: canvas.width, height: canvas.height, colors: colors.size });
    }
    return result;
  });
  ensure(seen.length === 2 && seen.every((one) => one.width === 320 && one.height === 240), JSON.stringify(seen));
  ensure(seen.every((one) => one.colors > 20), `pictures of nothing: ${JSON.stringify(seen)}`);
  await until('the age of both', () => page.evaluate(() =>
    [...document.querySelectorAll('.cameras figcaption span')].every((one) => /^([0-9]|1[0-9]) s ago$/.test(one.textContent))), 30000);
});

await check('both pictures are of the same moment', async () => {
  const taken = async (name) => Number((await fetch(`${url}camera/${name}.jpg`)).headers.get('Docent-Taken'));
  for (let i = 0; i < 5; i++) {
    const [a, b] = await Promise.all([taken('robot'), taken('scene')]);
    ensure(a > 0 && Math.abs(a - b) <= 0.51, `${a} and ${b}`); // fetched apart, one may be of the next pair
    await wait(300);
  }
});

await check('who has the newest picture is told so', async () => {
  await until('304', async () => {
    const etag = (await fetch(`${url}camera/scene.jpg`)).headers.get('ETag');
    const again = await fetch(`${url}camera/scene.jpg`, { headers: { 'If-None-Match': etag } });
    return again.status === 304 && (await again.text()) === '';
  }, 10000);
});

await check('live is live, every 15 s is rare, off is off', async () => {
  await choose('live');
  const live = await count(6);
  ensure(live >= 6, `live: ${live} in 6 s`);
  await page.screenshot({ path: join(pictures, 'cameras-live.png') });
  await choose('no pictures');
  await wait(1000);
  ensure((await count(4)) === 0, 'pictures came though none are wanted');
  ensure((await page.locator('.cameras figure').count()) === 0, 'and none is shown');
  await choose('every 15 s');
  await wait(1500);
  const rare = await count(8);
  ensure(rare <= 3, `every 15 s: ${rare} in 8 s`); // it also looks when the robot sets out or arrives
});

await check('the choice is kept', async () => {
  await choose('every 5 s');
  await page.reload();
  await page.waitForSelector('.cameras figure img');
  ensure((await page.locator('.cameras select').inputValue()) === '5', 'another rate');
});

await check('on a phone, too, and accessible', async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.locator('.cameras').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(pictures, 'cameras-phone.png') });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  ensure(!wide, 'the page scrolls sideways');
  const found = await axeSays(page);
  ensure(found.length === 0, found.join('\n'));
});

await check('nothing was complained about', async () => ensure(complaints.length === 0, complaints.join('\n')));
await finish();
