// A museum whose second language is written from right to left: its names on the robot's screen, and on a page that is not.
import { cpSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { check, ensure, finish, pictures, root, temporaryFolder } from './harness.mjs';
import { pressKey, shows } from './kiosk.mjs';
import { axeSays, listen, play } from './stage.mjs';

const TITLES = { 'The Z22 computer': 'الحاسوب Z22', 'The Transrapid': 'قطار ترانسرابيد', 'The highlights': 'أبرز المعروضات' };

function museumInArabic() {
  const folder = join(temporaryFolder('museum'), 'bonn');
  cpSync(join(root, 'museums', 'bonn'), folder, { recursive: true });
  const file = join(folder, 'museum.yaml');
  const text = readFileSync(file, 'utf8')
    .replace('languages: [en, de, fr]', 'languages: [en, ar]')
    .replace(/\{en: (content\/[\w.-]+)\.en\.md, de: [^}]*\}/g, '{en: $1.en.md, ar: content/story.ar.md}')
    .replace(/\{en: "([^"]*)", de: "[^"]*", fr: "[^"]*"\}/g, (_, english) => `{en: "${english}", ar: "${TITLES[english] ?? `معرض ${english}`}"}`);
  writeFileSync(file, text);
  writeFileSync(join(folder, 'content', 'story.ar.md'), 'هذه قصة قصيرة عن آلة قديمة جدا. ثم تنتهي.\n');
  return folder;
}

const stage = await play(museumInArabic());

await check('the screen turns round with the language, and its words stay whole', async () => {
  const { page, robot, context, complaints } = await listen({ viewport: { width: 1080, height: 1920 } });
  await page.goto(`${stage.url}/kiosk#${stage.key}`);
  await shows(page, 'home', 60000);
  const direction = () => page.evaluate(() => document.documentElement.dir);
  ensure((await direction()) === 'ltr', `English is written ${await direction()}`);
  await pressKey(page, '4');
  await page.locator('html[lang=ar]').waitFor();
  ensure((await direction()) === 'rtl', `Arabic is written ${await direction()}`);
  robot.mission('driving', { exhibit: 'zuse', tour: 'highlights', agenda: ['transrapid'] });
  await shows(page, 'driving');
  ensure((await page.locator('h1').innerText()) === TITLES['The Z22 computer'], await page.locator('h1').innerText());
  await page.screenshot({ path: join(pictures, 'kiosk-arabic.png') });
  const places = await page.evaluate(() => [...document.querySelectorAll('.choices button')].map((button) => {
    const [shape, words] = ['svg', 'span'].map((part) => button.querySelector(part).getBoundingClientRect());
    return shape.left >= words.right - 1;
  }));
  ensure(places.length > 0 && places.every(Boolean), 'the shapes are not before the words');
  ensure((await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)), 'the page is wider than the screen');
  const found = await axeSays(page);
  ensure(found.length === 0, found.join('\n'));
  ensure(complaints.length === 0, complaints.join('; '));
  await context.close();
});

await check('a name from right to left turns nothing else round on an English page', async () => {
  const { page, context, robot } = await listen({ viewport: { width: 1280, height: 800 } });
  const wish = { key: '00000001', source: 'web', visitor: 'ليلى', kind: 'exhibit', target: 'zuse', viewpoint: -1, state: 'queued', reason: null, created: 0, changed: 0 };
  robot.instead.set('board', () => ({ open: [wish, { ...wish, key: '00000002', visitor: 'Ada' }], closed: [] }));
  await page.goto(stage.url);
  const row = page.locator('small', { hasText: 'ليلى' }).first();
  await row.waitFor({ timeout: 30000 });
  await row.scrollIntoViewIfNeeded();
  const [first, second] = await row.locator('bdi').all();
  const [a, b] = [await first.boundingBox(), await second.boundingBox()];
  ensure(a.x < b.x, 'the second name stands before the first one');
  await page.screenshot({ path: join(pictures, 'page-arabic-name.png') });
  await context.close();
});

await finish();
