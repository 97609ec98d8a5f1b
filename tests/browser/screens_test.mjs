// The robot's own screen: each of its states in three languages and two sizes can be read and reached, and axe finds nothing.
import { join } from 'node:path';
import { check, ensure, finish, pause, pictures } from './harness.mjs';
import { pressKey, screenOf, shows } from './kiosk.mjs';
import { axeSays, listen, museumOfThreeLanguages, play } from './stage.mjs';

const SIZES = [[1080, 1920], [1920, 1080]];
const stage = await play(museumOfThreeLanguages());
const kiosk = `${stage.url}/kiosk#${stage.key}`;

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
  driving: ['driving', async ({ page, robot }) => {
    robot.mission('driving', { exhibit: 'zuse', tour: 'highlights', agenda: ['transrapid'] });
    await page.locator('.progress').waitFor();
  }],
  picture: ['driving', async ({ robot }) => robot.mission('driving', { exhibit: 'transrapid' })],
  blocked: ['blocked', async ({ robot }) => {
    robot.say({ type: 'path', points: [], goal: '', state: 'blocked', remaining: 4, blocked: 3 });
    robot.mission('driving', { exhibit: 'transrapid' });
  }],
  explaining: ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'zuse' }), speech(robot, 't/short', 'This is the Z22. It counts with tubes.'))],
  'long-story': ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'transrapid' }), speech(robot, 't/short', long))],
  'more-story': ['explaining', async ({ robot }) => (robot.mission('explaining', { exhibit: 'transrapid' }), speech(robot, 't/long', long))],
  'own-driving': ['driving', async (all) => (await beginOwn(all), all.robot.mission('driving', { exhibit: 'zuse', tour: 'highlights', agenda: ['transrapid'] }))],
  'own-story': ['explaining', async (all) => {
    await beginOwn(all);
    all.robot.mission('explaining', { exhibit: 'transrapid', tour: 'highlights', agenda: [] });
    speech(all.robot, 't/short', 'It carried visitors over nine hundred metres of track, without wheels.');
    await all.page.locator('.soon').waitFor();
  }],
  asking: ['asking', async ({ robot }) => asks(robot, 'transrapid')],
  answered: ['answered', async ({ page, robot }) => (asks(robot, 'transrapid'), await shows(page, 'asking'), await page.keyboard.press('3'))],
  poll: ['poll', async (all) => beginPoll(all)],
  price: ['poll', async (all) => (await beginPoll(all), await all.page.keyboard.press('3'), await pressKey(all.page, '1'))],
  clever: ['poll', async (all) => {
    await beginPoll(all);
    for (const key of ['3', '1', '1']) await pressKey(all.page, key);
  }],
  smaller: ['poll', async (all) => {
    await beginPoll(all);
    for (const key of ['3', '1', '1', '4']) await pressKey(all.page, key);
  }],
  thanks: ['thanks', async (all) => (await beginPoll(all), await all.page.keyboard.press('4'))],
  lost: ['lost', async ({ robot }) => (robot.instead.set('live', () => ({ pose: null })), robot.mission('relocalizing'))],
};
/** A tour that was asked for here is under way. */
async function beginOwn({ page, robot, reload }) {
  await wishes(page, [{ ...tourWish, made: Date.now() - 60e3, state: 'active' }]);
  robot.instead.set('board', () => ({ open: [{ ...fulfilled(robot), state: 'active' }], closed: [] }));
  await reload();
}
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
  page.setDefaultTimeout(30000);
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
        // Pictures for people: in one language, in all where somebody names a folder for them.
        if (language === 'de' || process.env.DOCENT_SCREENSHOTS) await page.screenshot({ path: join(pictures, `kiosk-${width}-${name}-${language}.png`) });
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

await finish();
