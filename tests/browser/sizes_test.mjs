// The page on phones and on a desk, alone and in company, by day and by night: everything is in reach, can be read and
// covers nothing that matters. What the robot says is changed on the way where a state is rare.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { answers, browse, build, check, ensure, finish, freePort, pause, pictures, root, start, temporaryFolder, until } from './harness.mjs';

const sizes = [[320, 640], [360, 740], [390, 844], [414, 896], [700, 450], [768, 1024], [1400, 900]]; // 700: of 1400 at a zoom of 200 %
const program = join(build, 'tests', 'web_stage', 'docent_web_stage');
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core'), 'utf8');

async function stage(museum, ...words) {
  const port = await freePort();
  start(program, [join(root, 'museums', museum), temporaryFolder('stage'), String(port), 'lost=0.5', 'speed=2', 'people=5', ...words]);
  const url = `http://127.0.0.1:${port}/`;
  await answers(url);
  return { url, museum: await (await fetch(`${url}api/museum.json`)).json() };
}

/** What the page sees of the robot: every message goes through `change`, none comes while `isDown`. */
const untouched = (message) => message;
const robot = { viewers: 1, isDown: false, change: untouched, sockets: new Set(), t: 0 };
async function open({ url }, options = {}) {
  const browser = await browse(options);
  await browser.page.routeWebSocket(/\/live$/, (socket) => {
    if (robot.isDown) return socket.close();
    robot.sockets.add(socket);
    const server = socket.connectToServer();
    server.onMessage((text) => {
      const message = JSON.parse(text);
      if (message.type === 'live') robot.t = message.t;
      if (message.type === 'health') message.viewers = robot.viewers;
      socket.send(JSON.stringify(robot.change(message)));
    });
  });
  await browser.page.goto(url);
  await browser.page.waitForSelector('.map[data-ready=true]');
  await browser.page.waitForSelector('[data-connection=open]');
  await browser.page.waitForSelector('.map[data-localized=true]', { timeout: 15000 });
  return browser;
}
const wires = (isDown) => {
  robot.isDown = isDown;
  if (!isDown) return;
  for (const socket of robot.sockets) socket.close();
  robot.sockets.clear();
};

/** What lies where it should not, as sentences. `home`: where the robot lives [px], for the hint. */
const faults = (page, museum) =>
  page.evaluate((museum) => {
    const found = [];
    document.querySelector('main').scrollTo(0, 0);
    const wide = document.documentElement.clientWidth;
    if (document.documentElement.scrollWidth > wide) found.push(`the page is ${document.documentElement.scrollWidth} px wide`);
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((one) => one.getClientRects().length > 0 && getComputedStyle(one).opacity !== '0');
    const name = (one) => one.getAttribute('aria-label') || one.innerText || one.className;
    const inside = (one) => {
      const box = one.getBoundingClientRect();
      if (box.left < 0 || box.right > wide + 0.5 || box.top < 0) found.push(`"${name(one)}" lies at ${box.left.toFixed(0)} to ${box.right.toFixed(0)} px of ${wide}`);
      if (one.scrollWidth > one.clientWidth + 1) found.push(`"${name(one)}" is cut off`);
    };
    const meet = (a, b, gap = 0) => a.left < b.right + gap && b.left < a.right + gap && a.top < b.bottom + gap && b.top < a.bottom + gap;
    const bars = shown('.top img, .status, .buttons, .tools, .hint, .title h1').filter((one) => one.getBoundingClientRect().width > 2);
    [...shown('.buttons button, .tools button'), ...bars].forEach(inside);
    bars.forEach((a, i) => bars.slice(i + 1).forEach((b) => {
      if (meet(a.getBoundingClientRect(), b.getBoundingClientRect())) found.push(`"${name(a)}" covers "${name(b)}"`);
    }));
    // The home, from where two markers are.
    const centre = (id) => {
      const box = document.querySelector(`[data-exhibit="${id}"]`).getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2];
    };
    const along = [...museum.exhibits].sort((a, b) => a.look_at[0] - b.look_at[0]);
    const [one, other] = [along[0], along[along.length - 1]];
    const scale = (centre(other.id)[0] - centre(one.id)[0]) / (other.look_at[0] - one.look_at[0]);
    const home = {
      x: centre(one.id)[0] + (museum.home[0] - one.look_at[0]) * scale,
      y: centre(one.id)[1] - (museum.home[1] - one.look_at[1]) * scale,
    };
    const reach = 0.5 * scale;
    const mat = { left: home.x - reach, right: home.x + reach, top: home.y - reach, bottom: home.y + reach };
    for (const bar of bars) if (meet(bar.getBoundingClientRect(), mat)) found.push(`"${name(bar)}" covers the home`);
    // Markers and names.
    const discs = shown('.exhibit .disc');
    const names = shown('.exhibit .name');
    for (const disc of discs) for (const bar of bars) {
      if (meet(bar.getBoundingClientRect(), disc.getBoundingClientRect(), -2)) found.push(`"${name(bar)}" covers ${disc.parentElement.dataset.exhibit}`);
    }
    names.forEach((a, i) => {
      for (const bar of bars) if (meet(a.getBoundingClientRect(), bar.getBoundingClientRect())) found.push(`"${name(bar)}" covers the name "${a.innerText}"`);
      for (const disc of discs) {
        if (disc.parentElement !== a.parentElement && meet(a.getBoundingClientRect(), disc.getBoundingClientRect(), -1)) found.push(`the name "${a.innerText}" covers ${disc.parentElement.dataset.exhibit}`);
      }
      for (const b of names.slice(i + 1)) if (meet(a.getBoundingClientRect(), b.getBoundingClientRect(), -1)) found.push(`the names "${a.innerText}" and "${b.innerText}" overlap`);
    });
    return found;
  }, museum);

/** Contrast of the page's colours, WCAG 2.1 1.4.3. */
const contrasts = (page) =>
  page.evaluate(() => {
    const style = getComputedStyle(document.documentElement);
    const brush = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    const light = (variable) => {
      brush.fillStyle = style.getPropertyValue(variable);
      brush.fillRect(0, 0, 1, 1);
      const [r, g, b] = [...brush.getImageData(0, 0, 1, 1).data].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const pairs = [['--accent', '--paper-solid', 4.5], ['--accent-ink', '--accent', 4.5], ['--soft', '--paper-solid', 4.5], ['--soft', '--outside', 4.5],
      ['--bad', '--paper-solid', 4.5], ['--teal', '--paper-solid', 4.5], ['--violet', '--paper-solid', 4.5], ['--good', '--paper-solid', 3], ['--fair', '--paper-solid', 3], ['--unknown', '--paper-solid', 3]];
    return pairs.flatMap(([a, b, least]) => {
      const [low, high] = [light(a), light(b)].sort((x, y) => x - y);
      const ratio = (high + 0.05) / (low + 0.05);
      return ratio < least ? [`${a} on ${b}: ${ratio.toFixed(2)}`] : [];
    });
  });
const axeSays = async (page) => {
  if (!(await page.evaluate(() => !!window.axe))) await page.evaluate(axe);
  return page.evaluate(async () => (await window.axe.run(document)).violations.map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 200)}`));
};

const bonn = await stage('bonn', 'horn=2');
const { page, complaints } = await open(bonn);
page.setDefaultTimeout(30000);
const dark = (isDark) => page.evaluate((isDark) => (document.documentElement.dataset.theme === 'dark') !== isDark && document.querySelector('.buttons button[aria-label="Light or dark"]').click(), isDark);
await page.emulateMedia({ reducedMotion: 'reduce' });
await page.reload();
await page.waitForSelector('.map[data-localized=true]');

for (const [width, height] of sizes) {
  await check(`${width} px: everything is in reach and covers nothing`, async () => {
    wires(false);
    await page.setViewportSize({ width, height });
    for (const viewers of [1, 4]) {
      robot.viewers = viewers;
      await page.locator('.status', { hasText: viewers > 1 ? `${viewers} watching` : /^live$/ }).waitFor();
      for (const isDark of [false, true]) {
        await dark(isDark);
        await pause(250);
        const found = await faults(page, bonn.museum);
        await page.screenshot({ path: join(pictures, `size-${width}-${viewers}-${isDark ? 'dark' : 'light'}.png`) });
        ensure(found.length === 0, `${viewers} viewers: ${found.join('; ')}`);
      }
    }
    for (const language of ['DE', 'FR']) {
      await page.locator('.buttons .word', { hasText: language }).click();
      await pause(150);
      const found = await faults(page, bonn.museum);
      await page.screenshot({ path: join(pictures, `size-${width}-${language.toLowerCase()}.png`) });
      await page.locator('.buttons .word', { hasText: 'EN' }).click();
      ensure(found.length === 0, `in ${language}: ${found.join('; ')}`);
    }
    wires(true);
    await page.waitForSelector('[data-connection=lost]');
    await pause(150);
    const found = await faults(page, bonn.museum);
    await page.screenshot({ path: join(pictures, `size-${width}-away.png`) });
    wires(false);
    ensure(found.length === 0, `without a line: ${found.join('; ')}`);
    await page.waitForSelector('[data-connection=open]', { timeout: 12000 });
  });
  await check(`${width} px: axe finds nothing, by day and by night`, async () => {
    await page.getByRole('button', { name: 'Look inside', exact: true }).click();
    await page.locator('.help summary').click();
    for (const isDark of [false, true]) {
      await dark(isDark);
      await pause(100);
      const words = [...(await axeSays(page)), ...(await contrasts(page))];
      ensure(words.length === 0, `${isDark ? 'dark' : 'light'}: ${words.join('\n')}`);
      await page.evaluate(() => document.querySelectorAll('[data-exhibit]')[6].click());
      const more = await axeSays(page);
      ensure(more.length === 0, `a card, ${isDark ? 'dark' : 'light'}: ${more.join('\n')}`);
      await page.keyboard.press('Escape');
    }
    await page.locator('.help summary').click();
    await page.getByRole('button', { name: 'Close the look inside' }).click();
  });
}

await check('the horn is heard and seen', async () => {
  await page.getByRole('button', { name: 'Turn sound on' }).click();
  const reply = await page.waitForResponse((one) => /\/audio\/[0-9a-f]{16}\.wav$/.test(one.url()), { timeout: 15000 });
  ensure(reply.ok() && reply.headers()['content-type'] === 'audio/wav', `${reply.status()} ${reply.headers()['content-type']}`);
  await page.locator('.bubble', { hasText: 'Beep beep!' }).waitFor({ timeout: 15000 });
  await page.getByRole('button', { name: 'Turn sound off' }).click();
});

await check('a long story scrolls to the sentence that is spoken', async () => {
  const text = Array.from({ length: 60 }, (_, i) => `This is sentence number ${i + 1} of a long story.`).join(' ');
  let start = 0;
  robot.change = (message) =>
    message.type === 'speech' ? { type: 'speech', id: 'long', state: 'speaking', text, language: 'en', start, duration: 200, audio: '' } : message;
  for (const part of [0.1, 0.55, 0.95]) {
    start = robot.t - part * 200;
    for (const socket of robot.sockets) socket.send(JSON.stringify(robot.change({ type: 'speech' })));
    await page.locator('.story .saying', { hasText: `number ${Math.floor(part * 60) + 1} ` }).waitFor();
    await pause(300);
    const [spoken, box] = [await page.locator('.story .saying').boundingBox(), await page.locator('.story').boundingBox()];
    ensure(spoken.y >= box.y - 1 && spoken.y + spoken.height <= box.y + box.height + 1, `at ${part * 100} % the sentence lies at ${(spoken.y - box.y).toFixed(0)} px of ${box.height.toFixed(0)}`);
  }
  await page.locator('.now').screenshot({ path: join(pictures, 'story.png') });
  robot.change = untouched;
});

await check('one wish at a time is on the way', async () => {
  const wish = { source: 'web', visitor: 'Ada', viewpoint: -1, state: 'active', reason: '', created: 1, changed: 2 };
  robot.change = (message) => {
    if (message.type === 'mission') return { ...message, phase: 'driving', tour: 'highlights', exhibit: 'zuse' };
    if (message.type !== 'board') return message;
    return { type: 'board', open: [{ ...wish, key: '1', kind: 'tour', target: 'highlights' }, { ...wish, key: '2', kind: 'exhibit', target: 'zuse' }], closed: [] };
  };
  for (const socket of robot.sockets) socket.send(JSON.stringify(robot.change({ type: 'board' })));
  await page.locator('.queue .state', { hasText: 'has begun' }).waitFor();
  const words = await page.locator('.queue .state').allInnerTexts();
  ensure(words.filter((word) => word === 'on the way').length === 1, words.join(', '));
  await page.locator('.queue').screenshot({ path: join(pictures, 'tour-and-wish.png') });
  robot.change = untouched;
});

await check('nothing scrolls into the buttons', async () => {
  const look = () =>
    page.evaluate(() => {
      const [buttons, panel] = [document.querySelector('.buttons'), document.querySelector('.panel')];
      return { bottom: buttons.getBoundingClientRect().bottom, top: panel.getBoundingClientRect().top, colour: getComputedStyle(buttons).backgroundColor };
    });
  for (const [width, height] of [[1400, 900], [390, 844]]) {
    await page.setViewportSize({ width, height });
    const { bottom, top, colour } = await look();
    if (width > 860) ensure(top >= bottom, `${width} px: the panel begins at ${top} px, the buttons end at ${bottom} px`);
    ensure(colour.startsWith('rgb('), `${width} px: the buttons let ${colour} through`);
    await page.evaluate(() => [document.querySelector('.panel'), document.querySelector('main')].forEach((one) => one.scrollTo(0, 380)));
    await pause(200);
    await page.screenshot({ path: join(pictures, `scrolled-${width}.png`) });
    await page.evaluate(() => [document.querySelector('.panel'), document.querySelector('main')].forEach((one) => one.scrollTo(0, 0)));
  }
  await page.setViewportSize({ width: 1400, height: 900 });
});

await check('a lost robot says what it does about it', async () => {
  robot.change = (message) => {
    if (message.type === 'mission') return { ...message, phase: 'driving', exhibit: 'zuse', text: { en: 'I am on my way to the Z22.' } };
    return message.type === 'live' ? { ...message, pose: null } : message;
  };
  const old = JSON.stringify(robot.change({ type: 'mission', tour: '', agenda: [], explained: 0, tours: 0, served: 0, prompt: null }));
  for (const socket of robot.sockets) socket.send(old);
  await page.waitForSelector('.map[data-localized=false]');
  await page.locator('.now h2', { hasText: 'Where am I?' }).waitFor();
  const text = await page.locator('.now').innerText();
  ensure(!text.includes('on my way') && text.includes('look around'), text);
  ensure((await page.locator('.now .far').count()) === 0, 'tells how far it is to go');
  await page.screenshot({ path: join(pictures, 'lost-under-way.png') });
  robot.change = untouched;
});

await check('nothing complains', async () => {
  const real = complaints.filter((text) => !/ERR_|WebSocket/.test(text));
  ensure(real.length === 0, real.join('; '));
});
await page.context().close();

await check('on a phone every name is shown at some zoom', async () => {
  robot.change = untouched;
  wires(false);
  const smithsonian = await stage('smithsonian');
  for (const width of [360, 414]) {
    const { page } = await open(smithsonian, { viewport: { width, height: 896 } });
    await pause(600);
    const seen = new Set();
    const look = async () => {
      await pause(250);
      const shown = await page.evaluate(() => [...document.querySelectorAll('.exhibit')].filter((one) => {
        const name = one.querySelector('.name');
        const box = name.getBoundingClientRect();
        return getComputedStyle(name).opacity === '1' && box.left >= 0 && box.right <= innerWidth && box.top >= 0 && box.bottom <= innerHeight;
      }).map((one) => one.dataset.exhibit));
      for (const id of shown) seen.add(id);
    };
    await look();
    for (const { id } of smithsonian.museum.exhibits) {
      if (seen.has(id)) continue;
      await page.getByRole('button', { name: 'Show everything' }).click();
      await pause(300);
      // Two fingers on its marker, as it were.
      const box = await page.locator(`[data-exhibit="${id}"] .disc`).first().boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      for (let zoom = 0; zoom < 4 && !seen.has(id); ++zoom) {
        await page.mouse.wheel(0, -300);
        await look();
      }
    }
    await page.screenshot({ path: join(pictures, `names-${width}.png`) });
    const missing = smithsonian.museum.exhibits.filter(({ id }) => !seen.has(id)).map(({ id }) => id);
    ensure(missing.length === 0, `at ${width} px nowhere: ${missing.join(', ')}`);
    await page.context().close();
  }
});

await check('the Smithsonian shows its names', async () => {
  robot.change = untouched;
  wires(false);
  const smithsonian = await stage('smithsonian');
  const { page } = await open(smithsonian, { viewport: { width: 1400, height: 900 } });
  await pause(600);
  const named = await page.evaluate(() => [...document.querySelectorAll('.exhibit .name')].filter((one) => getComputedStyle(one).opacity === '1').length);
  await page.screenshot({ path: join(pictures, 'smithsonian.png') });
  ensure(named >= 0.9 * smithsonian.museum.exhibits.length, `${named} of ${smithsonian.museum.exhibits.length} names`);
  const found = await faults(page, smithsonian.museum);
  ensure(found.length === 0, found.join('; '));

  // With the first wish the hint goes and the building moves: walls and markers together.
  const wallOverMarker = () =>
    page.evaluate(() => {
      const canvas = document.querySelector('.map canvas');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const isWall = (at) => Math.abs(data[at] - 70) < 8 && Math.abs(data[at + 1] - 63) < 8 && Math.abs(data[at + 2] - 92) < 8;
      let first = 0;
      while (first < data.length && !isWall(first)) first += 4;
      const marker = document.querySelector('[data-exhibit]').getBoundingClientRect();
      return { gap: marker.top - (Math.floor(first / 4 / canvas.width) * canvas.clientHeight) / canvas.height, y: marker.top };
    });
  const before = await wallOverMarker();
  await page.locator('[data-exhibit]').nth(4).click();
  await page.click('.go');
  await until('the building moves', async () => Math.abs((await wallOverMarker()).y - before.y) > 5, 5000);
  await pause(300);
  const after = await wallOverMarker();
  ensure(Math.abs(after.gap - before.gap) < 2, `walls and markers are ${(after.gap - before.gap).toFixed(1)} px apart`);
  await page.context().close();
});

await check('the page comes compressed', async () => {
  let [sent, whole, scripts] = [0, 0, 0];
  const html = await (await fetch(bonn.url)).text();
  const files = ['', 'api/museum.json', 'icon.svg', ...[...html.matchAll(/(?:src|href)="\.?\/(assets\/[^"]+)"/g)].map((match) => match[1])];
  ensure(files.length >= 5, files.join());
  for (const file of files) {
    const reply = await fetch(bonn.url + file, { headers: { 'Accept-Encoding': 'gzip, br' } });
    sent += Number(reply.headers.get('content-length'));
    if (file.endsWith('.js')) scripts += Number(reply.headers.get('content-length'));
    whole += (await reply.arrayBuffer()).byteLength;
    ensure(reply.headers.get('vary') === 'Accept-Encoding' || reply.headers.get('content-encoding') === null, `${file}: no Vary`);
  }
  console.log(`        ${(sent / 1000).toFixed(0)} kB for ${(whole / 1000).toFixed(0)} kB, of which ${(scripts / 1000).toFixed(0)} kB JavaScript`);
  ensure(scripts > 10_000 && scripts < 150_000, `${scripts} bytes of JavaScript`);
  ensure(sent < 0.45 * whole, `${sent} bytes of ${whole}`);
});

await finish();
