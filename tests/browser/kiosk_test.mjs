// The robot's own screen with the robot of the stage: tours by touch, by keys and by the four buttons, and lines that break.
import { execFileSync } from 'node:child_process';
import { closeSync, constants, existsSync, openSync, readFileSync, writeSync } from 'node:fs';
import { join } from 'node:path';
import { check, ensure, finish, pause, pictures, temporaryFolder, until } from './harness.mjs';
import { lit, MOMENT, pressKey, screenOf, shows, tap } from './kiosk.mjs';
import { axeSays, listen, museumOfThreeLanguages, play } from './stage.mjs';

const pipe = join(temporaryFolder('buttons'), 'event0');
execFileSync('mkfifo', [pipe]);
// A question is open for longer than in the museum: a browser of a busy machine needs seconds for a new line.
const stage = await play(museumOfThreeLanguages(), `buttons=${pipe}`, 'ask=15');
const kiosk = `${stage.url}/kiosk#${stage.key}`;

/** A press as the kernel tells it: struct input_event of a key that goes down and up. */
const buttons = openSync(pipe, constants.O_WRONLY | constants.O_NONBLOCK);
function writeButton(number) {
  const event = (type, code, value) => {
    const bytes = Buffer.alloc(24);
    bytes.writeUInt16LE(type, 16);
    bytes.writeUInt16LE(code, 18);
    bytes.writeInt32LE(value, 20);
    return bytes;
  };
  writeSync(buttons, Buffer.concat([event(1, number + 1, 1), event(0, 0, 0), event(1, number + 1, 0), event(0, 0, 0)]));
}

async function pressButton(number) {
  await pause(MOMENT);
  writeButton(number);
}

const board = (page) => page.evaluate(() => new Promise((resolve) => {
  const socket = new WebSocket(`ws://${location.host}/live`);
  socket.onmessage = (event) => {
    const message = JSON.parse(event.data);
    if (message.type !== 'board') return;
    socket.close();
    resolve([...message.open, ...message.closed]);
  };
}));
const poll = () => (existsSync(join(stage.state, 'poll.csv')) ? readFileSync(join(stage.state, 'poll.csv'), 'utf8').trim().split('\n').slice(1) : []);

await check('a whole tour by four buttons only', async () => {
  const { page, robot, complaints, context } = await listen({ viewport: { width: 1080, height: 1920 } });
  await page.goto(kiosk);
  await shows(page, 'home', 40000);
  ensure((await lit(page)) === '1 2 3 4', `lit are ${await lit(page)}`);
  await until('the lamps follow', async () => robot.sent.some((message) => message.type === 'lamps' && message.lit.join() === '1,2,3,4'), 3000);
  await pressButton(3);
  await shows(page, 'help');
  await pressButton(3); // back
  await shows(page, 'home');
  await pressButton(1);
  await shows(page, 'driving', 15000);
  const asked = (await board(page)).filter((entry) => entry.kind === 'tour' && entry.state === 'active');
  ensure(asked.length === 1 && asked[0].source === 'kiosk' && asked[0].target === 'highlights', JSON.stringify(asked));
  await pressButton(1); // end it?
  await shows(page, 'ending');
  await pressButton(1); // no
  await shows(page, 'driving');
  // More at the first exhibit, on at the second.
  await shows(page, 'explaining', 60000);
  await page.locator('.soon').waitFor();
  ensure((await lit(page)) === '2', `lit are ${await lit(page)}`); // the stop may be skipped, more and next come
  await shows(page, 'asking', 20000);
  ensure((await lit(page)) === '3 4', `lit are ${await lit(page)}`);
  await page.screenshot({ path: join(pictures, 'kiosk-tour-asking.png') });
  await pressButton(2); // dark: nothing happens
  await pause(300);
  ensure((await screenOf(page)) === 'asking', 'a dark button does something');
  await pressButton(3);
  await until('the long story', async () => (await page.locator('.text').innerText()).includes('long'), 8000);
  await shows(page, 'driving', 30000);
  await shows(page, 'asking', 60000);
  await pressButton(4);
  await shows(page, 'poll', 30000);
  const before = poll().length;
  await pressButton(3); // likes it
  await page.locator('h1', { hasText: 'good tour' }).waitFor();
  await pressButton(2); // undecided
  await page.locator('h1', { hasText: '1,000 dollars' }).waitFor();
  await page.screenshot({ path: join(pictures, 'kiosk-poll-price.png') });
  await pressButton(1); // no
  await page.locator('h1', { hasText: 'clever' }).waitFor();
  await pressButton(4); // something smaller
  await page.locator('button', { hasText: 'amoeba' }).waitFor();
  await pressButton(2);
  await shows(page, 'thanks');
  await shows(page, 'home', 10000);
  const answers = poll().slice(before).map((line) => line.split(',').slice(2).join());
  ensure(answers.join(' ') === 'en,liked,yes en,satisfied,undecided en,price,no en,intelligence,amoeba', answers.join(' '));
  ensure(complaints.length === 0, complaints.join('; '));
  await context.close();
});

await check('stops that nobody wants are skipped, on the way and while they are explained', async () => {
  const { page, robot, complaints, context } = await listen({ viewport: { width: 1080, height: 1920 }, hasTouch: true });
  await page.goto(kiosk);
  await page.locator('main[data-screen=home], main[data-screen=poll]').waitFor({ timeout: 120000 });
  if ((await screenOf(page)) === 'poll') await tap(page, 'button.blue');
  await shows(page, 'home', 15000);
  await tap(page, 'button.red');
  await shows(page, 'driving', 15000);
  const title = () => page.locator('h1').innerText();
  const first = await title();
  const progress = await page.locator('.progress').innerText();
  ensure(progress.startsWith('stop 1 of'), progress);
  await page.screenshot({ path: join(pictures, 'kiosk-skip-driving.png') });
  await tap(page, 'button.yellow');
  await until('it drives to the next stop', async () => (await title()) !== first && (await screenOf(page)) === 'driving', 5000);
  ensure((await page.locator('.progress').innerText()).startsWith('stop 2 of'), await page.locator('.progress').innerText());
  await shows(page, 'explaining', 60000);
  await page.screenshot({ path: join(pictures, 'kiosk-skip-explaining.png') });
  await tap(page, 'button.yellow');
  await until('it says no more of it', async () => !['explaining', 'asking'].includes(await screenOf(page)), 5000);
  const skips = robot.sent.filter((message) => message.type === 'skip').map(({ exhibit }) => exhibit);
  ensure(skips.length === 2 && skips[0] !== skips[1], JSON.stringify(skips));
  ensure(complaints.length === 0, complaints.join('; '));
  await context.close();
});

await check('by keys, in French; a key and its button at once are one press', async () => {
  const { page, robot, context } = await listen({ viewport: { width: 1920, height: 1080 } });
  await page.goto(kiosk);
  await shows(page, 'home', 40000);
  await pressKey(page, '4');
  await shows(page, 'languages');
  await pressKey(page, '3');
  await page.locator('h1', { hasText: 'Je vous fais visiter' }).waitFor();
  ensure((await page.locator('html').getAttribute('lang')) === 'fr', 'the page says it is in another language');
  await pressKey(page, '2'); // other tours
  writeButton(2);
  await shows(page, 'tours');
  await pause(500);
  ensure((await screenOf(page)) === 'tours', 'the button came after the key and was a second press');
  await pressKey(page, '3'); // the others
  await page.locator('button', { hasText: 'Six minutes avec moi' }).waitFor();
  await pressKey(page, '4'); // back home
  await shows(page, 'home');
  await pressKey(page, '1');
  await shows(page, 'driving', 15000);
  ensure(robot.sent.find((message) => message.type === 'request').language === 'fr', 'the tour is in another language');
  await shows(page, 'explaining', 60000);
  await page.locator('.text', { hasText: 'histoire en français' }).waitFor();
  // A crash of the screen does not matter.
  await page.reload();
  const begin = Date.now();
  await shows(page, 'explaining', 2500);
  console.log(`        right again ${Date.now() - begin} ms after the reload`);
  await page.locator('.soon', { hasText: 'Dans un instant' }).waitFor();
  await shows(page, 'asking', 20000);
  await page.reload();
  await shows(page, 'asking', 2500);
  await shows(page, 'driving', 20000); // nobody pressed: the tour went on
  await pressKey(page, '4');
  await shows(page, 'languages');
  await pressKey(page, '1');
  await shows(page, 'driving');
  ensure((await page.locator('html').getAttribute('lang')) === 'en', 'the language cannot be changed on the way');
  await context.close();
});

await check('by touch, in German; a line that breaks at a question; a poll that nobody answers ends by itself', async () => {
  const { page, robot, context } = await listen({ viewport: { width: 1080, height: 1920 }, hasTouch: true });
  await page.goto(kiosk);
  await page.locator('main[data-screen=home], main[data-screen=poll]').waitFor({ timeout: 300000 });
  if ((await screenOf(page)) === 'poll') await tap(page, 'button.blue');
  await shows(page, 'home', 15000);
  await tap(page, 'button.blue');
  await pause(MOMENT);
  await page.locator('button', { hasText: 'Deutsch' }).tap();
  await page.locator('h1', { hasText: 'Darf ich Sie' }).waitFor();
  await tap(page, 'button.red');
  await shows(page, 'asking', 60000);
  // The line breaks while a question is open: the screen has it again at once, and it can still be answered.
  for (const socket of robot.sockets) await socket.close();
  robot.sockets.clear();
  await until('a new line', () => robot.sockets.size > 0, 3000);
  await shows(page, 'asking', 2500);
  await tap(page, 'button.green');
  await shows(page, 'answered');
  await shows(page, 'poll', 90000);
  await tap(page, 'button.red');
  await page.locator('h1', { hasText: 'gute Führung' }).waitFor();
  await page.reload();
  await page.locator('h1', { hasText: 'gute Führung' }).waitFor({ timeout: 3000 });
  await shows(page, 'home', 40000); // and leaves the rest
  ensure(poll().at(-1).endsWith('de,liked,no'), poll().at(-1));
  await context.close();
});

await check('a dead line is seen, and the screen comes back by itself', async () => {
  const { page, context } = await listen({ viewport: { width: 1080, height: 1920 } });
  await page.goto(kiosk);
  await page.locator('main:not([data-screen=opening]):not([data-screen=away])').waitFor({ timeout: 20000 });
  await stage.stage.stop('SIGKILL');
  await shows(page, 'away', 5000);
  await page.screenshot({ path: join(pictures, 'kiosk-away.png') });
  const broken = await axeSays(page);
  ensure(broken.length === 0, broken.join('\n'));
  ensure((await lit(page)) === '', 'buttons are lit that lead nowhere');
  stage.again();
  await shows(page, 'home', 60000);
  await context.close();
});

closeSync(buttons);
await check('who asked for a tour here ends it here, and says so twice', async () => {
  const { page, context } = await listen({ viewport: { width: 1920, height: 1080 } });
  await page.goto(kiosk);
  await shows(page, 'home', 120000);
  await pressKey(page, '1');
  await shows(page, 'driving', 15000);
  await pressKey(page, '1');
  await shows(page, 'ending');
  await pressKey(page, '3');
  await until('it is called off', async () => {
    const tours = (await board(page)).filter((entry) => entry.kind === 'tour');
    return tours.some((entry) => entry.state === 'cancelled') && tours.every((entry) => entry.state !== 'active');
  });
  await context.close();
});

await finish();
