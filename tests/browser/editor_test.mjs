// The museum editor on the operators' page, at a Web server among invented messages: a picture, a room, hours, a link and a tour
// come into the museum's folder. The whole robot does the rest in museum_test and setup_test.
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { browse, build, check, editorMap, ensure, finish, pictures } from './harness.mjs';
import { axeSays, museumOfThreeLanguages, play } from './stage.mjs';

const PASSWORD = 'a long way from Bonn';
const museum = museumOfThreeLanguages();
const { url, state } = await play(museum);
const made = spawnSync(join(build, 'bin', 'docent'), ['web-account', 'add', 'ada', '--role', 'operator', '--state', state], { input: `${PASSWORD}\n`, encoding: 'utf8' });
ensure(made.status === 0, made.stderr);
const { page, complaints } = await browse({ viewport: { width: 1360, height: 900 } });
const yaml = () => readFileSync(join(museum, 'museum.yaml'), 'utf8');
const field = async (name, text) => {
  await page.locator(`.editor-form [name="${name}"]`).fill(text);
  await page.locator(`.editor-form [name="${name}"]`).blur();
};
const listed = (text) => page.locator('.editor-list button', { hasText: text }).click();
const idle = () => page.waitForSelector('.museum-card[data-busy=false]', { timeout: 30000 });

await check('an operator opens the editor', async () => {
  await page.goto(`${url}/operate`);
  await page.waitForSelector('.login[data-rank=viewer]');
  await page.locator('.login input').first().fill('ada');
  await page.locator('.login input[type=password]').fill(PASSWORD);
  await page.locator('.login button[type=submit]').click();
  await page.waitForSelector('.stop[data-open=true]');
  await page.locator('.stop-button').click();
  await page.waitForSelector('.stop[data-stopped=true]');
  await page.locator('.edit-museum').click();
  await idle();
  await page.waitForSelector('.editor-map svg');
});
await check('what is no picture is refused, and a large one is made small and kept', async () => {
  await listed('The Transrapid');
  ensure((await page.locator('.editor-picture').getAttribute('data-picture')) === 'content/transrapid.svg', 'its old picture');
  const send = (name, mimeType, buffer) => page.locator('[name=picture]').setInputFiles({ name, mimeType, buffer });
  await send('notes.txt', 'text/plain', Buffer.from('no picture'));
  await page.waitForSelector('.editor-picture [role=alert]');
  const photograph = await page.evaluate(() => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [2400, 1600];
    const pen = canvas.getContext('2d');
    for (let i = 0; i < 200; ++i) {
      pen.fillStyle = `hsl(${i * 7} 60% ${20 + (i * 37) % 60}%)`;
      pen.fillRect((i * 613) % 2400, (i * 419) % 1600, 300, 200);
    }
    return canvas.toDataURL('image/png').split(',')[1];
  });
  await send('train.png', 'image/png', Buffer.from(photograph, 'base64'));
  await page.waitForSelector('.editor-picture[data-busy=false][data-picture^="pictures/"] img', { timeout: 30000 });
  await page.screenshot({ path: join(pictures, 'editor-picture.png') });
});
await check('a room, hours and a tour', async () => {
  await page.locator('.editor-tools [data-tool=room]').click();
  await editorMap(page).click([15.2, 17.6]);
  await field('id', 'middle');
  for (const language of ['en', 'de', 'fr']) await field(`name-${language}`, `Middle ${language}`);
  ensure((await page.locator('[data-room=middle]').count()) === 1, 'it is not on the map');
  await page.locator('[data-do=hours]').click();
  await field('hours-open', 'nine to five');
  await page.waitForSelector('.editor-fault');
  await field('hours-open', '9-18, 19:00-20:30');
  await page.locator('.editor-form [data-do=tour]').click();
  await field('id', 'short');
  for (const language of ['en', 'de', 'fr']) await field(`title-${language}`, `Short ${language}`);
  for (const stop of ['zuse', 'transrapid']) await page.locator('[name=stop]').selectOption(stop);
  await field('daily', '16:30');
  const says = await axeSays(page);
  ensure(says.length === 0, says.join('; '));
  await page.screenshot({ path: join(pictures, 'editor-tour.png') });
});
await check('the list of recordings says what may be spoken', async () => {
  await page.locator('.recordings summary').click();
  await page.waitForSelector('.recordings li');
  ensure((await page.locator('.recordings li').count()) >= 26, 'a text of each exhibit in each language');
  ensure((await page.locator('.recordings').innerText()).includes('content/audio/en/zuse.short'), 'its file');
});
await check('all of it comes into the folder, beside what was there', async () => {
  const before = yaml();
  await page.locator('[data-do=publish]').click();
  await page.waitForSelector('.museum-card[data-busy=true]');
  for (let i = 0; i < 100 && yaml() === before; ++i) await new Promise((resolve) => setTimeout(resolve, 100));
  const faults = await page.locator('.museum-card .faults').allInnerTexts();
  ensure(faults.length === 0, faults.join());
  const now = yaml();
  const picture = /picture: "(pictures\/[0-9a-f]{16}\.jpg)"/.exec(now)?.[1];
  ensure(picture && readFileSync(join(museum, picture)).subarray(0, 2).toString('hex') === 'ffd8', 'no picture');
  ensure(now.includes('- {id: middle, name: {de: "Middle de", en: "Middle en", fr: "Middle fr"}, at: {x: 15.'), 'no room');
  ensure(now.includes('open: {max_speed: 0.7, hours: ["09:00-18:00", "19:00-20:30"]}'), 'no hours');
  ensure(now.includes('exhibits: [zuse, transrapid], daily: ["16:30"]}'), 'no tour');
  ensure(now.includes('web: {max_speed: 0.4, wait_s: 30, hours: ["18:30-21:30"]}') && now.startsWith('# museum.yaml'), 'something else has changed');
});
await check('nothing complains', () => ensure(complaints.every((text) => /WebSocket|ERR_|Failed to load/.test(text)), complaints.join('; ')));
await finish();
