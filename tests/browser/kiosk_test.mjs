// The robot's own screen: each of its states in three languages and two sizes, by touch, by keys and by the four buttons.
import { execFileSync } from 'node:child_process';
import { closeSync, constants, existsSync, openSync, readFileSync, writeSync } from 'node:fs';
import { join } from 'node:path';
import { check, ensure, finish, pause, pictures, temporaryFolder, until } from './harness.mjs';
import { axeSays, listen, museumOfThreeLanguages, play } from './stage.mjs';

const SIZES = [[1080, 1920], [1920, 1080]];
const pipe = join(temporaryFolder('buttons'), 'event0');
execFileSync('mkfifo', [pipe]);
const museum = museumOfThreeLanguages();
// A question is open for longer than in the museum: a browser of a busy machine needs seconds for a new line.
const stage = await play(museum, `buttons=${pipe}`, 'ask=15');
const kiosk = `${stage.url}/kiosk#${stage.key}`;
const shows = (page, name, patience = 8000) => page.locator(`main[data-screen=${name}]`).waitFor({ timeout: patience });
const screenOf = (page) => page.locator('main').getAttribute('data-screen');
/** A press too soon after another is none: people need a moment, too. */
const MOMENT = 400;
const pressKey = async (page, key) => (await pause(MOMENT), await page.keyboard.press(key));
const tap = async (page, selector) => (await pause(MOMENT), await page.locator(selector).tap());
const lit = (page) => page.locator('main').getAttribute('data-lit');

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

/** What cannot be read or reached, as sentences. */
const faults = (page) =>
  page.evaluate(() => {
    const [wide, high] = [innerWidth, innerHeight];
    const u = Math.min(wide / 100, (0.92 * high) / 100);
    const found = [];
    const name = (one) => (one.innerText ?? one.getAttribute('class')).slice(0, 40);
    const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
    if (document.documentElement.scrollWidth > wide || document.documentElement.scrollHeight > high) found.push('the page is larger than the screen');
    for (const one of document.querySelectorAll('h1, .text, li, .over, .hellos span, button > span, small, .soon')) {
      const box = one.getBoundingClientRect();
      const range = document.createRange();
      range.selectNodeContents(one);
      const ink = range.getBoundingClientRect();
      if (ink.left < 0 || ink.top < 0 || ink.right > wide + 0.5 || ink.bottom > high + 0.5) found.push(`"${name(one)}" leaves the screen`);
      if (ink.width > box.width + 1) found.push(`"${name(one)}" is wider than its box`);
      for (const node of [...one.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE)) {
        for (const word of node.data.matchAll(/[^\s-]+/g)) {
          range.setStart(node, word.index);
          range.setEnd(node, word.index + word[0].length);
          if (new Set([...range.getClientRects()].map((line) => Math.round(line.top))).size > 1) found.push(`"${word[0]}" is broken`);
        }
      }
      const size = parseFloat(getComputedStyle(one).fontSize);
      if (size < 4.4 * u - 0.1) found.push(`"${name(one)}" is ${size} px high`);
    }
    const parts = ['.words', '.choices', '.visor, .picture'].map((selector) => document.querySelector(selector)).filter(Boolean);
    parts.forEach((a, i) => parts.slice(i + 1).forEach((b) => {
      if (meet(a.getBoundingClientRect(), b.getBoundingClientRect())) found.push(`"${name(a)}" and "${name(b)}" overlap`);
    }));
    for (const button of document.querySelectorAll('button')) {
      const box = button.getBoundingClientRect();
      if (box.width < 15 * u || box.height < 15 * u) found.push(`"${name(button)}" is ${box.width.toFixed(0)} by ${box.height.toFixed(0)} px`);
      if (box.top < 0.46 * high) found.push(`"${name(button)}" begins at ${((100 * box.top) / high).toFixed(0)} % of the height`);
      for (const part of button.children) {
        const inner = part.getBoundingClientRect();
        if (inner.left < box.left || inner.right > box.right || inner.top < box.top || inner.bottom > box.bottom) found.push(`"${name(button)}" is too small for its words`);
      }
    }
    return found;
  });

await check('a page without the key is not the robot’s screen', async () => {
  const { page, context, robot } = await listen();
  for (const key of ['', 'x', '0123456789abcdef0123456789abcdef']) {
    await page.goto(`${stage.url}/?`);
    await page.goto(`${stage.url}/kiosk#${key}`);
    await shows(page, 'stranger', 12000);
    ensure((await page.locator('button').count()) === 0, 'it can be asked for something');
  }
  ensure(robot.sent.filter((message) => message.type !== 'watch').length === 0, `it said ${JSON.stringify(robot.sent)}`);
  await page.screenshot({ path: join(pictures, 'kiosk-stranger.png') });
  const found = await axeSays(page);
  ensure(found.length === 0, found.join('\n'));
  await context.close();
});

// Each state, as the robot would say it -----------------------------------------------------------------------------------

const speech = (robot, id, text) =>
  robot.say({ type: 'speech', id, state: 'speaking', text, language: 'en', start: robot.t - 1, duration: 60, audio: '' });
const silence = (robot) => robot.say({ type: 'speech', id: '', state: 'done', text: '', language: 'en', start: 0, duration: 0, audio: '' });
const asks = (robot, exhibit) =>
  robot.mission('asking', { exhibit, prompt: { id: `t${robot.t}/more`, text: { en: 'More?', de: 'Mehr?', fr: 'Encore ?' }, language: 'de', options: ['more', 'next'], default: 'next', deadline: robot.t + 5 } });
const long = 'In nineteen hundred and seventy-nine it carried the visitors of an exhibition over nine hundred metres of track, without wheels and without a driver, and everybody wanted to ride.';
const tourWish = { id: '018f3a6c-5b2e-7c3d-9a4b-0123456789ab', kind: 'tour', target: 'highlights', viewpoint: -1, reason: null, seen: true };
const wishes = (page, list) => page.evaluate((list) => localStorage.setItem('docent.wishes', JSON.stringify(list)), list);
const fulfilled = (robot) => ({ key: '456789ab', source: 'kiosk', visitor: '', kind: 'tour', target: 'highlights', viewpoint: -1, state: 'fulfilled', reason: null, created: robot.t - 200, changed: robot.t - 2 });

const states = {
  home: ['home', async ({ robot }) => robot.mission('idle')],
  charging: ['home', async ({ robot }) => robot.mission('charging')],
  tours: ['tours', async ({ page, robot }) => (robot.mission('idle'), await shows(page, 'home'), await page.keyboard.press('2'))],
  languages: ['languages', async ({ page, robot }) => (robot.mission('idle'), await shows(page, 'home'), await page.keyboard.press('4'))],
  help: ['help', async ({ page, robot }) => (robot.mission('idle'), await shows(page, 'home'), await page.keyboard.press('3'))],
  coming: ['coming', async ({ page, robot, reload }) => {
    robot.mission('idle');
    await wishes(page, [{ ...tourWish, made: Date.now(), state: 'sent', seen: false }]);
    await reload();
  }],
  refused: ['refused', async ({ page, robot, reload }) => {
    robot.mission('idle');
    await wishes(page, [{ ...tourWish, made: Date.now(), state: 'refused', reason: { word: 'closed', about: '' } }]);
    await reload();
  }],
  driving: ['driving', async ({ robot }) => robot.mission('driving', { exhibit: 'zuse' })],
  picture: ['driving', async ({ robot }) => robot.mission('driving', { exhibit: 'transrapid' })],
  blocked: ['blocked', async ({ robot }) => {
    robot.say({ type: 'path', points: [], goal: '', state: 'blocked', remaining: 4, blocked: 3 });
    robot.mission('driving', { exhibit: 'transrapid' });
  }],
  explaining: ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'zuse' }), speech(robot, 't/short', 'This is the Z22. It counts with tubes.'))],
  'long-story': ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'transrapid' }), speech(robot, 't/short', long))],
  'more-story': ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'transrapid' }), speech(robot, 't/long', long))],
  asking: ['asking', async ({ robot }) => asks(robot, 'transrapid')],
  answered: ['answered', async ({ page, robot }) => (asks(robot, 'transrapid'), await shows(page, 'asking'), await page.keyboard.press('3'))],
  poll: ['poll', async (all) => beginPoll(all)],
  clever: ['poll', async (all) => (await beginPoll(all), await all.page.keyboard.press('3'), await pressKey(all.page, '1'))],
  smaller: ['poll', async (all) => {
    await beginPoll(all);
    for (const key of ['3', '1', '4']) await pressKey(all.page, key);
  }],
  thanks: ['thanks', async (all) => (await beginPoll(all), await all.page.keyboard.press('4'))],
  lost: ['lost', async ({ robot }) => (robot.instead.set('live', () => ({ pose: null })), robot.mission('relocalizing'))],
};
async function beginPoll({ page, robot, reload }) {
  robot.mission('going_home');
  await wishes(page, [{ ...tourWish, made: Date.now() - 200e3, state: 'fulfilled' }]);
  robot.instead.set('board', () => ({ open: [], closed: [fulfilled(robot)] }));
  await reload();
  await shows(page, 'poll');
}

for (const [width, height] of SIZES) {
  const browser = await listen({ viewport: { width, height } });
  const { page, robot } = browser;
  page.setDefaultTimeout(8000);
  await page.goto(kiosk);
  await shows(page, 'home', 20000).catch(() => {});
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const reload = async () => {
    await page.reload();
    await page.locator('main:not([data-screen=opening])').waitFor();
  };
  for (const [name, [expected, set]] of Object.entries(states)) {
    await check(`${width} x ${height}, ${name}: can be read, reached, and axe finds nothing`, async () => {
      for (const language of ['en', 'de', 'fr']) {
        robot.instead.clear();
        robot.mission('idle');
        silence(robot);
        robot.say({ type: 'path', points: [], goal: '', state: 'idle', remaining: 0, blocked: 0 });
        robot.instead.set('live', () => ({ pose: [9, 4, 0], avoid: undefined }));
        robot.instead.set('board', () => ({ open: [], closed: [] }));
        await page.evaluate((language) => {
          localStorage.clear();
          sessionStorage.setItem('docent.kiosk.language', language);
        }, language);
        await reload();
        await shows(page, 'home');
        await set({ page, robot, reload });
        await shows(page, expected);
        await pause(250);
        await page.screenshot({ path: join(pictures, `kiosk-${width}-${name}-${language}.png`) });
        ensure((await screenOf(page)) === expected, `shows ${await screenOf(page)}`);
        const found = await faults(page);
        ensure(found.length === 0, `${language}: ${found.join('; ')}`);
        if (language !== 'de') continue;
        const broken = await axeSays(page);
        ensure(broken.length === 0, broken.join('\n'));
      }
    });
  }
  await check(`${width} x ${height}: nothing complains`, async () => ensure(browser.complaints.length === 0, browser.complaints.join('; ')));
  await browser.context.close();
}

// The robot of the stage -------------------------------------------------------------------------------------------------

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
  ensure(!(await lit(page)).includes('1'), 'a tour can be asked for twice');
  // More at the first exhibit, on at the second.
  await shows(page, 'explaining', 60000);
  await page.locator('.soon').waitFor();
  ensure((await lit(page)) === '', `lit are ${await lit(page)}`);
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
  await page.locator('h1', { hasText: 'clever' }).waitFor();
  await pressButton(4); // something smaller
  await page.locator('button', { hasText: 'amoeba' }).waitFor();
  await pressButton(2);
  await shows(page, 'thanks');
  await shows(page, 'home', 10000);
  const answers = poll().slice(before).map((line) => line.split(',').slice(2).join());
  ensure(answers.join(' ') === 'en,liked,yes en,satisfied,undecided en,intelligence,amoeba', answers.join(' '));
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
  await pressKey(page, '4');
  await page.locator('button', { hasText: 'Six minutes avec moi' }).waitFor();
  await pressKey(page, '3'); // nothing lies there
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
  await page.locator('main[data-screen=home], main[data-screen=poll]').waitFor({ timeout: 120000 });
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
await finish();
