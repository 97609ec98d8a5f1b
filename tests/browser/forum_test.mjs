// The forum: a visitor writes, a moderator reads and shows it, others read and report it; on a phone and on a desk.
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { answers, browse, build, check, ensure, finish, freePort, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { axeSays } from './stage.mjs';

const state = temporaryFolder('forum');
const made = spawnSync(join(build, 'bin', 'docent'), ['web-account', 'add', 'mary', '--role', 'moderator', '--state', state], {
  input: 'a long way from Bonn\n', encoding: 'utf8',
});
ensure(made.status === 0, made.stderr);
const port = await freePort();
start(join(build, 'tests', 'web_stage', 'docent_web_stage'), [join(root, 'museums', 'bonn'), state, String(port), 'lost=0.5']);
const url = `http://127.0.0.1:${port}/`;
await answers(url);

const TITLE = 'Does it <b>sleep</b>?';
const TEXT = 'I saw it at night.\n\n<script>document.title = "hacked"</script> \'; DROP TABLE posts; --';
async function visitor(options) {
  const browser = await browse(options);
  await browser.page.goto(url);
  await browser.page.waitForSelector('[data-connection=open]');
  await browser.page.locator('.talk summary').click();
  await browser.page.waitForSelector('.forum[data-ready=true]');
  return browser;
}
const phone = await visitor({ viewport: { width: 390, height: 844 }, hasTouch: true });
await check('the forum is loaded when it is opened', async () => {
  await phone.page.waitForSelector('.forum .empty');
  await phone.page.locator('.talk').scrollIntoViewIfNeeded();
  await phone.page.screenshot({ path: join(pictures, 'forum-phone.png') });
});
await check('a visitor writes under a name, and waits for a moderator', async () => {
  const { page } = phone;
  await page.locator('.forum .go').click();
  await page.locator('.forum input').first().fill(TITLE);
  await page.locator('.forum textarea').fill(TEXT);
  await page.locator('.forum input[autocomplete=nickname]').fill('Eve "the robot" <i>');
  await page.locator('.forum button[type=submit]').click();
  await page.waitForSelector('.toast.shown');
  await page.waitForSelector('.forum .empty');
});
const desk = await browse({ viewport: { width: 1280, height: 900 } });
await check('a moderator reads and shows it', async () => {
  const { page } = desk;
  await page.goto(`${url}operate`);
  await page.locator('.login input').first().fill('mary');
  await page.locator('.login input[type=password]').fill('a long way from Bonn');
  await page.locator('.login button[type=submit]').click();
  await page.waitForSelector('.moderation li');
  ensure((await page.locator('.moderation li b').textContent()) === TITLE, await page.locator('.moderation li').textContent());
  await page.locator('.moderation li').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(pictures, 'forum-moderation.png') });
  await page.locator('.moderation .choices button').first().click();
  await until('it is so', () => page.evaluate(() => document.querySelectorAll('.moderation li').length === 0));
});
const reader = await visitor({ viewport: { width: 1280, height: 900 } });
await check('everybody reads it, as text and nothing else', async () => {
  const { page } = reader;
  await page.locator('.forum .thread').first().click();
  await page.waitForSelector('.forum li[data-post] p');
  ensure((await page.locator('.forum li[data-post] p').textContent()) === TEXT, await page.locator('.forum').textContent());
  ensure((await page.locator('.forum h4').textContent()) === TITLE, 'the title');
  ensure((await page.locator('.forum li script, .forum li b, .forum li i').count()) === 0, 'it was read as HTML');
  ensure((await page.title()) !== 'hacked', 'a script ran');
  await page.locator('.talk').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(pictures, 'forum-desk.png') });
});
await check('who is known writes at once, and others answer', async () => {
  const { page } = phone;
  await page.reload();
  await page.waitForSelector('[data-connection=open]');
  await page.locator('.talk summary').click();
  await page.locator('.forum .thread').first().click();
  await page.locator('.forum .go').click();
  ensure((await page.locator('.forum input').count()) === 0, 'it asks for the name again');
  await page.locator('.forum textarea').fill('It charges at night.');
  await page.locator('.forum button[type=submit]').click();
  await until('it is so', () => page.evaluate(() => document.querySelectorAll('.forum li[data-post][data-state=shown]').length === 2));
});
await check('a reader reports a post, and the moderator sees it', async () => {
  await reader.page.locator('.forum .report').first().click();
  await reader.page.waitForSelector('.toast.shown');
  await desk.page.reload();
  await desk.page.waitForSelector('.moderation li');
  ensure(/1 reports/.test(await desk.page.locator('.moderation li').textContent()), await desk.page.locator('.moderation').textContent());
});
await check('who is sent away writes no more, and what they wrote is gone', async () => {
  await desk.page.locator('.moderation .choices button').nth(2).click();
  await until('it is so', () => desk.page.evaluate(() => document.querySelectorAll('.moderation li').length === 0));
  const seen = await (await fetch(`${url}api/v1/forum`)).json();
  ensure(seen.threads.length === 0, JSON.stringify(seen));
  await phone.page.locator('.forum .go').click();
  await phone.page.locator('.forum textarea').fill('Am I still here?');
  await phone.page.locator('.forum button[type=submit]').click();
  await phone.page.waitForSelector('.toast.shown');
  const answered = await phone.page.evaluate(() => fetch('/api/v1/login').then((reply) => reply.json()));
  ensure(answered.rank === 'viewer', JSON.stringify(answered));
});
await check('the pages are accessible', async () => {
  for (const { page } of [phone, reader, desk]) {
    const found = await axeSays(page);
    ensure(found.length === 0, JSON.stringify(found).slice(0, 1500));
  }
});
await check('no page of another site writes or reads for a visitor', async () => {
  const foreign = await fetch(`${url}api/v1/visitor`, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Origin: 'http://evil.test' }, body: '{"name":"Eve"}',
  });
  ensure(foreign.status === 403, `${foreign.status}`);
  ensure(!foreign.headers.get('access-control-allow-origin'), 'others may read');
});
await finish();
