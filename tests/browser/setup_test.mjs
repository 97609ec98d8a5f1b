// docent setup, as a technician uses it: from a folder that is not there to the first tour. The robot maps a small simulated
// hall by itself, is driven to what shall be marked, is put away over night, and gives its tour. All of the museum is made on the
// page: five exhibits with pictures and links, two tours, rooms, hours, and areas where it must not go. That it touches nothing
// is said by the truth channel of its recordings.
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { browse, build, check, editorMap, ensure, finish, freePort, pause, pictures, root, start, temporaryFolder, until } from './harness.mjs';
import { readRecording } from './recording.mjs';
import { axeSays } from './stage.mjs';

const docent = join(build, 'bin', 'docent');
const base = temporaryFolder('setup');
const [museum, state] = [join(base, 'hall'), join(base, 'state')];
const port = String(await freePort());
const words = [
  'setup', museum, '--sim', join(root, 'tests', 'browser', 'worlds', 'small-hall.yaml'), '--no-cameras', '--port', port,
  '--domain', process.env.DOCENT_TEST_DOMAIN ?? '72', '--state', state,
];
/** The address that it prints, with the password of this time. */
async function begin() {
  const robot = start(docent, words);
  const address = await until('an address is printed', () => {
    ensure(robot.code === null, `docent setup ended with ${robot.code}: ${robot.output.slice(-600)}`);
    return robot.output.match(/http:\/\/127\.0\.0\.1:\d+\/setup#\w+/)?.[0];
  }, 60000);
  return { robot, address };
}
let { robot, address } = await begin();
const { page, complaints } = await browse({ viewport: { width: 1360, height: 900 } });
const step = (name, patience = 60000) => page.waitForSelector(`.setup[data-step=${name}][data-busy=false][data-beginning=false]`, { timeout: patience });
const press = (what) => page.locator(`.setup [data-do=${what}]`).click();
const shot = (name) => page.screenshot({ path: join(pictures, `setup-${name}.png`) });

const { click } = editorMap(page);
const tool = (name) => page.locator(`.editor-tools [data-tool=${name}]`).click();
/** Where the robot says that it is: of the drawing on the map. */
const robotAt = () => page.evaluate(() => {
  const [, x, y, heading] = document.querySelector('.editor-map .robot')?.getAttribute('transform').match(/translate\((\S+) (\S+)\) rotate\((\S+)\)/) ?? [];
  return x === undefined ? null : [Number(x), Number(y), (Number(heading) * Math.PI) / 180];
});
/** Holds the knob, pulled so far up and to the left, until `isEnough` says so of where the robot is. A robot that stands is
 * pushed once more, as a person would. */
async function drive(up, left, isEnough, patience = 30000) {
  const begun = await robotAt();
  for (const end = Date.now() + patience; ;) {
    if (await push(up, left, isEnough, end)) break;
    ensure(Date.now() < end, `the robot came from ${begun} to ${await robotAt()} only, in ${patience / 1000} s`);
    console.log(`pushed once more at ${await robotAt()}`);
  }
  await pause(1500); // it stands
}
async function push(up, left, isEnough, end) {
  if (await page.locator('.steer .go').count()) await page.locator('.steer .go').click();
  await page.waitForSelector('.steer[data-wheel=true]');
  await page.locator('.pad').scrollIntoViewIfNeeded();
  const box = await page.locator('.pad').boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - (left * box.width) / 2, y - (up * box.height) / 2, { steps: 3 });
  let moved = { at: await robotAt(), time: Date.now() };
  try {
    for (; Date.now() < end && Date.now() < moved.time + 6000; await pause(50)) {
      const at = await robotAt();
      if (isEnough(at)) return true;
      if (far(at, moved.at) > 0.05 || turned(at[2], moved.at[2]) > 0.05) moved = { at, time: Date.now() };
    }
    return false;
  } finally {
    await page.mouse.up();
  }
}
const far = ([ax, ay], [bx, by]) => Math.hypot(ax - bx, ay - by);
const turn = (from, to) => Math.atan2(Math.sin(to - from), Math.cos(to - from));
const turned = (from, to) => Math.abs(turn(from, to));
async function face(direction) {
  for (let tries = 0; tries < 4; ++tries) { // a slow browser lets go late
    const gap = turn((await robotAt())[2], direction);
    if (Math.abs(gap) < 0.15) return;
    await drive(0, Math.sign(gap) * 0.25, (at) => turn(at[2], direction) * Math.sign(gap) < 0.1, 60000);
  }
}
/** Drives from wherever the robot stands in the hall, by way of the passage between its rooms, to a place of the western one. */
async function comeTo(place) {
  const east = (await robotAt())[0];
  const ways = [[6.4, 2.9], [4.5, 2.4]].filter(([x]) => x < east - 0.3);
  for (const goal of [...ways, place]) {
    const from = await robotAt();
    if (far(from, goal) < 0.4) continue;
    await face(Math.atan2(goal[1] - from[1], goal[0] - from[0]));
    await drive(0.6, 0, (at) => far(at, goal) < 0.35 || far(at, from) > far(from, goal), 60000);
  }
}

/** A step without which the others would only wait. */
const must = async (name, action) => {
  if (await check(name, action)) return;
  await shot('failed');
  console.log(robot.output.slice(-1500));
  await finish();
};

await must('the printed address opens the assistant, which asks for the name', async () => {
  await page.goto(address);
  await step('name');
  ensure(!page.url().includes('#'), 'the password stays in the address');
  await page.locator('[name=museum]').fill('The small hall');
  await page.locator('[name=language][value=de]').check();
  await shot('name');
  const says = await axeSays(page);
  ensure(says.length === 0, `axe: ${says.join('; ')}`);
  await press('name');
  await step('map');
});
await must('what no sensor sees is fenced on the map that has just begun', async () => {
  await page.waitForSelector('.map-card[data-order=wait]', { timeout: 60000 });
  await page.waitForSelector('.editor-map .robot', { timeout: 60000 });
  await until('the map has begun', async () => Number((await page.locator('[data-figure=known]').textContent()).replace(/\D/g, '')) > 5, 60000);
  await pause(2500);
  await tool('hazard');
  for (const corner of [[7.7, 1.8], [8.9, 1.8], [8.9, 2.6], [7.7, 2.6], [7.7, 1.8]]) await click(corner);
  await page.locator('select[name=kind]').selectOption('glass');
  await shot('fence');
  ensure(await page.locator('[data-do=by-itself]').isDisabled(), 'it may drive although a mark is not kept');
  await press('fence');
  await step('map');
  await page.waitForSelector('.map-card[data-order=wait]', { timeout: 60000 });
  ensure(readFileSync(join(museum, 'museum.yaml'), 'utf8').includes('kind: glass'), 'the mark is not in museum.yaml');
});
await must('the robot maps the hall by itself', async () => {
  await press('by-itself');
  await page.waitForSelector('.map-card[data-order=by_itself][data-state=exploring]', { timeout: 30000 });
  await pause(15000);
  await shot('exploring');
  await page.waitForSelector('.map-card[data-state=done]', { timeout: 420000 });
  await pause(1000);
  await shot('map');
  const known = Number((await page.locator('[data-figure=known]').textContent()).replace(/\D/g, ''));
  ensure(known > 45 && known < 70, `${known} m² of some 60 are known`);
  await press('keep');
  await step('hazards');
  ensure(existsSync(join(museum, 'map.pgm')), 'there is no map');
});
await must('it knows its place in its own map at once, and the mark has stayed', async () => {
  await page.waitForSelector('.place[data-localized=true]', { timeout: 30000 });
  await page.waitForSelector('.editor-map polygon.hazard');
  await page.waitForSelector('.editor-map .robot', { timeout: 30000 });
});
await must('a hazard is marked by driving round it', async () => {
  const corners = [];
  await comeTo([3.2, 2.2]); // where the mapping ended differs
  await face(0);
  await tool('hazard');
  const mark = async () => {
    corners.push(await robotAt());
    await page.locator('.editor-hint button', { hasText: 'where the robot is' }).click();
  };
  await mark();
  const first = await robotAt();
  await drive(0.6, 0, (at) => far(at, first) > 0.5);
  await mark();
  const second = await robotAt();
  await drive(0, 0.4, (at) => turned(second[2], at[2]) > 1.5);
  await drive(0.6, 0, (at) => far(at, second) > 0.6);
  await mark();
  await page.locator('.editor-hint button', { hasText: 'Close' }).click();
  await shot('hazards');
  const third = await robotAt();
  await drive(0.6, 0, (at) => far(at, third) > 0.7);
  await press('next');
  await page.waitForSelector('.setup[data-busy=false][data-beginning=false]', { timeout: 60000 });
  const faults = await page.locator('.faults').allTextContents();
  ensure(faults.length === 0, faults.join(' '));
  await step('exhibits');
  const yaml = readFileSync(join(museum, 'museum.yaml'), 'utf8');
  const written = [...yaml.split('hazard-2')[1].split('\n')[0].matchAll(/\[(-?[\d.]+), (-?[\d.]+)\]/g)].map(([, x, y]) => [Number(x), Number(y)]);
  ensure(written.length === 3, `${written.length} corners in museum.yaml`);
  written.forEach((corner, i) => ensure(far(corner, corners[i]) < 0.05, `corner ${i + 1} is ${far(corner, corners[i]).toFixed(2)} m from where the robot was`));
});
const write = async (which, texts) => {
  for (const [language, text] of Object.entries(texts)) await page.locator(`[name=${which}-${language}]`).fill(text);
};
await must('exhibits are placed on the map, and by driving there', async () => {
  await page.waitForSelector('.place[data-localized=true]', { timeout: 60000 });
  await page.waitForSelector('.editor-map .robot', { timeout: 30000 });
  await tool('exhibit');
  await click([3.4, 5.2]);
  await write('title', { en: 'The globe', de: 'Der Globus' });
  await write('short', { en: 'The earth is round.', de: 'Die Erde ist rund.' });
  const begun = await robotAt();
  await drive(0, 0.5, (at) => turned(begun[2], at[2]) > 0.8);
  await tool('exhibit');
  const at = await robotAt();
  await page.locator('.editor-hint button', { hasText: 'stands before it' }).click();
  await write('title', { en: 'The wall', de: 'Die Wand' });
  await write('short', { en: 'This is a wall.', de: 'Das ist eine Wand.' });
  await shot('exhibits');
  await press('save');
  await step('exhibits');
  const known = await page.evaluate(() => fetch('/api/museum.json').then((reply) => reply.json()));
  ensure(known.exhibits.length === 2, `${known.exhibits.length} exhibits`);
  ensure(far(known.exhibits[1].pose, at) < 0.05, 'the second one is not where the robot was');
});
/** A picture that is larger than the museum keeps it, as a camera would give it. */
const photograph = (hue) => page.evaluate((hue) => {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [2400, 1600];
  const pen = canvas.getContext('2d');
  for (let i = 0; i < 400; ++i) {
    pen.fillStyle = `hsl(${hue + i / 5} 60% ${20 + (i * 37) % 60}%)`;
    pen.fillRect((i * 613) % 2400, (i * 419) % 1600, 300, 200);
  }
  return canvas.toDataURL('image/png').split(',')[1];
}, hue).then((base64) => Buffer.from(base64, 'base64'));
const listed = (text) => page.locator('.editor-list button', { hasText: text }).click();
await must('three more exhibits, each of the five with a picture and a link', async () => {
  const more = [
    [[8.6, 4.9], { en: 'The clock', de: 'Die Uhr' }, { en: 'It stands still.', de: 'Sie steht.' }],
    [[1.5, 4.6], { en: 'The cabinet', de: 'Der Schrank' }, { en: 'It is empty.', de: 'Er ist leer.' }],
    [[6.6, 2.6], { en: 'The bench', de: 'Die Bank' }, { en: 'Take a seat.', de: 'Nehmen Sie Platz.' }],
  ];
  for (const [place, title, short] of more) {
    await tool('exhibit');
    await click(place);
    await write('title', title);
    await write('short', short);
    await page.locator('[name=short-de]').blur();
  }
  ensure((await page.locator('.of-exhibit').count()) === 5, 'five exhibits');
  await listed('The globe');
  await page.locator('[name=picture]').setInputFiles({ name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('no picture') });
  await page.waitForSelector('.editor-picture [role=alert]');
  for (const [i, name] of ['The globe', 'The wall', 'The clock', 'The cabinet', 'The bench'].entries()) {
    await listed(name);
    await page.locator('[name=picture]').setInputFiles({ name: `${i}.png`, mimeType: 'image/png', buffer: await photograph(60 * i) });
    await page.waitForSelector('.editor-picture[data-busy=false][data-picture^="pictures/"] img', { timeout: 30000 });
    await page.locator('[data-do=link]').click();
    await page.locator('[name=url-0]').fill(`https://example.org/${i}`);
    await write('link-0', { en: `More of ${name}`, de: 'Mehr davon' });
    await page.locator('[name=link-0-de]').blur();
  }
  await shot('pictures');
});
await must('rooms, hours and a tour of their own', async () => {
  for (const [place, id, name] of [[[2.4, 3.4], 'west', { en: 'The west', de: 'Der Westen' }], [[7.4, 3.9], 'east', { en: 'The east', de: 'Der Osten' }]]) {
    await tool('room');
    await click(place);
    await page.locator('.editor-form [name=id]').fill(id);
    await write('name', name);
    await page.locator('[name=name-de]').blur();
  }
  ensure((await page.locator('[data-room]').count()) === 2, 'two rooms on the map');
  await page.locator('[data-do=hours]').click();
  await page.locator('[name=hours-open]').fill('nine to five');
  await page.locator('[name=hours-open]').blur();
  await page.waitForSelector('.editor-fault');
  await page.locator('[name=hours-open]').fill('0-24');
  await page.locator('[name=hours-open]').blur();
  await page.locator('.editor-form [data-do=tour]').click();
  await page.locator('.editor-form [name=id]').fill('short');
  await write('title', { en: 'The short tour', de: 'Die kurze Führung' });
  for (const stop of ['exhibit-1', 'exhibit-4', 'exhibit-3']) await page.locator('[name=stop]').selectOption(stop);
  await page.locator('[name=daily]').fill('14:00');
  await page.locator('[name=daily]').blur();
  ensure((await page.locator('.of-tour').count()) === 2, 'two tours');
  const says = await axeSays(page);
  ensure(says.length === 0, `axe: ${says.join('; ')}`);
  await shot('made');
  await press('save');
  await page.waitForSelector('.setup[data-busy=false][data-beginning=false]', { timeout: 60000 });
  const faults = await page.locator('.faults').allTextContents();
  ensure(faults.length === 0, faults.join(' '));
  const known = await page.evaluate(() => fetch('/api/museum.json').then((reply) => reply.json()));
  ensure(known.exhibits.length === 5 && known.exhibits.every((one) => one.links.length === 1), JSON.stringify(known.exhibits).slice(0, 600));
  ensure(known.tours.find((one) => one.id === 'short')?.daily.join() === '14:00', JSON.stringify(known.tours));
  ensure(['west', 'east'].every((id) => known.rooms.some((room) => room.id === id)), JSON.stringify(known.rooms));
  ensure(known.hazards.length === 2, 'where it must not go');
  const sizes = await page.evaluate((paths) => Promise.all(paths.map(async (path) => {
    const reply = await fetch(path);
    const picture = await createImageBitmap(await reply.blob());
    return [reply.headers.get('content-type'), picture.width, picture.height].join(' ');
  })), known.exhibits.map((one) => one.picture));
  ensure(sizes.every((size) => size === 'image/jpeg 1600 1067'), sizes.join(', '));
  ensure(/open: \{hours: \["00:00-24:00"\]\}/.test(readFileSync(join(museum, 'museum.yaml'), 'utf8')), 'the hours');
});
await must('over night: the set-up goes on where it was', async () => {
  await robot.stop();
  ({ robot, address } = await begin());
  await page.goto('about:blank');
  await page.goto(address);
  await step('exhibits');
  ensure((await page.locator('.of-exhibit').count()) === 5, 'the exhibits are not there');
  await press('next');
  await step('check');
});
await must('the check finds no fault, and says what is missing', async () => {
  await page.waitForSelector('.check-card[data-faults="0"]', { timeout: 30000 });
  ensure((await page.locator('.checks .missing').count()) === 1, 'that there is no charger is not said');
  await shot('check');
  await press('tour');
  await step('tour');
});
await must('the first tour', async () => {
  await page.waitForSelector('.tour-card [data-do=start]:not([disabled])', { timeout: 240000 });
  await press('start');
  await page.waitForSelector('.tour-card[data-phase=driving]', { timeout: 60000 });
  await pause(3000);
  await shot('tour');
  await step('done', 420000);
  await shot('done');
  ensure(readFileSync(join(museum, 'setup.yaml'), 'utf8').includes('step: done'), 'setup.yaml does not say so');
});
await check('visitors see the picture and the link of an exhibit', async () => {
  await page.goto(new URL('./', address).href.split('#')[0]);
  await page.locator('[data-exhibit="exhibit-1"]').click({ timeout: 30000 });
  await page.waitForSelector('.exhibit-card .links a[href="https://example.org/0"]');
  await until('the picture is shown', () => page.evaluate(() => (document.querySelector('.exhibit-card img.picture')?.naturalWidth ?? 0) === 1600));
});
await check('docent check finds no fault in what was made without a line of YAML', () => {
  const checked = spawnSync(docent, ['check', museum], { encoding: 'utf8' });
  ensure(checked.status === 0 && checked.stdout.includes('5 exhibits'), checked.stdout + checked.stderr);
});
await check('nothing was touched, and all exhibits were explained', async () => {
  await robot.stop();
  const folder = join(state, 'recordings');
  let contacts = 0;
  const explained = new Set();
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.mcap'))) {
    readRecording(join(folder, file), ['truth/contact', 'docent/event'], (topic, message) => {
      if (topic === 'truth/contact') ++contacts;
      else if (message.kind === 'explained') explained.add(message.subject);
    });
  }
  ensure(contacts === 0, `${contacts} contacts`);
  ensure(explained.size === 5, `explained: ${[...explained].join(', ')}`);
});
await check('no page complained', () => ensure(complaints.every((text) => /WebSocket|Failed to load resource|ERR_CONNECTION/.test(text)), complaints.join('\n')));
await finish();
