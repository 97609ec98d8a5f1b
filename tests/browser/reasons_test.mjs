// Why something is as it is, and what is asked: every reader gets it in their own language, whatever the robot speaks.
import { join } from 'node:path';
import { check, ensure, finish, pause, pictures } from './harness.mjs';
import { axeSays, listen, museumOfThreeLanguages, play } from './stage.mjs';

const stage = await play(museumOfThreeLanguages());
const { page, robot, complaints, hosts, context } = await listen({ viewport: { width: 1280, height: 860 } });

const id = '018f3a6c-5b2e-7c3d-9a4b-0123456789ab';
const entry = (key, target, state, word, about = '', more = {}) => ({
  key, source: 'web', visitor: 'Emmy', kind: 'exhibit', target, viewpoint: -1, state, reason: word && { word, about }, created: robot.t - 60, changed: robot.t - 1, ...more,
});
const board = () => ({
  type: 'board', revision: Date.now(), open_count: 2,
  open: [
    entry('00000001', 'transrapid', 'queued', 'charging_first'),
    entry('00000002', 'cyclotron', 'queued', 'way_blocked'),
  ],
  closed: [
    entry(id.slice(-8), 'zuse', 'refused', 'closed'),
    entry('00000004', 'highlights', 'failed', 'not_reached', 'zuse transrapid', { kind: 'tour' }),
  ],
});
const question = { en: 'Would you like to hear more?', de: 'Möchten Sie mehr hören?', fr: 'Voulez-vous en savoir plus ?' };
/** What stands on the page, by language. */
const expected = {
  en: {
    inside: 'Look inside',
    refused: 'The museum is closed.', charging: 'I am charging my battery first.', again: 'The way was blocked for too long. I will try again.',
    missed: /I could not get to: .*Z.*, .*Transrapid/, hindered: 'Someone is in my way.', wait: 'Too many people are waiting already. Please try again later.',
  },
  de: {
    inside: 'Blick ins Innere',
    refused: 'Das Museum ist geschlossen.', charging: 'Ich lade erst meinen Akku.', again: 'Der Weg war zu lange versperrt. Ich versuche es noch einmal.',
    missed: /Ich kam nicht hin: .*Z.*, .*Transrapid/, hindered: 'Mir steht jemand im Weg.', wait: 'Es warten schon zu viele. Bitte versuchen Sie es später noch einmal.',
  },
  fr: {
    inside: 'Regarder à l’intérieur',
    refused: 'Le musée est fermé.', charging: 'Je recharge d’abord ma batterie.', again: 'Le passage est resté bloqué trop longtemps. Je réessaierai.',
    missed: /Je n’ai pas pu atteindre\u00a0: .*Z.*, .*Transrapid/, hindered: 'Quelqu’un me barre le passage.', wait: 'Trop de personnes attendent déjà. Réessayez plus tard, s’il vous plaît.',
  },
};
/** As French is set, whoever wrote it. */
const set = (text) => text.replace(' ?', '\u00a0?');
const textOf = (selector) => page.locator(selector).innerText();

for (const [language, words] of Object.entries(expected)) {
  await check(`${language}: why a wish waits, failed or was refused`, async () => {
    await page.goto(stage.url);
    await page.evaluate(([language, id]) => {
      localStorage.setItem('docent.language', JSON.stringify(language));
      localStorage.setItem('docent.wishes', JSON.stringify([{ id, kind: 'exhibit', target: 'zuse', viewpoint: -1, made: Date.now(), state: 'sent', reason: null, seen: false }]));
    }, [language, id]);
    robot.instead.clear();
    robot.instead.set('live', (live) => ({ avoid: { ...live.avoid, reason: { word: 'person_in_way', about: '' } } }));
    await page.reload();
    await page.waitForSelector('.map[data-localized=true]', { timeout: 40000 });
    robot.say(board());
    const toast = await page.locator('.toast').innerText();
    ensure(toast.includes(words.refused), toast);
    const queue = await textOf('.queue');
    for (const reason of [words.refused, words.charging, words.again]) ensure(queue.includes(reason), `${reason} is not in ${queue}`);
    ensure(words.missed.test(queue), queue);
    const cut = await page.locator('.queue .why').evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth + 1 || one.clientHeight < 10).length);
    ensure(cut === 0, `${cut} reasons cannot be read`);
    robot.say({ type: 'refused', id: `${id.slice(0, -1)}c`, reason: { word: 'too_many_wait', about: '' } });
    await page.locator('.toast', { hasText: words.wait }).waitFor();
    await page.screenshot({ path: join(pictures, `reasons-refused-${language}.png`) });
  });

  await check(`${language}: a question that is spoken in German`, async () => {
    robot.mission('asking', { exhibit: 'zuse', prompt: { id: `t${robot.t}/more`, text: question, language: 'de', options: ['more', 'next'], default: 'next', deadline: robot.t + 30 } });
    robot.say({ type: 'speech', id: 't/question', state: 'speaking', text: question.de, language: 'de', start: robot.t, duration: 20, audio: '' });
    await page.locator('.prompt', { hasText: set(question[language]) }).waitFor();
    await pause(400);
    ensure((await textOf('.bubble')) === set(question[language]), await textOf('.bubble'));
    const whole = await textOf('body');
    for (const [other, text] of Object.entries(question)) {
      ensure(other === language || !whole.includes(text), `${other} stands on the page, too`);
    }
    await page.screenshot({ path: join(pictures, `reasons-question-${language}.png`) });
    const found = await axeSays(page);
    ensure(found.length === 0, found.join('\n'));
  });

  await check(`${language}: why the robot stands`, async () => {
    await page.getByRole('button', { name: words.inside }).click();
    await page.locator('.inside .reason', { hasText: words.hindered }).waitFor();
    await page.screenshot({ path: join(pictures, `reasons-inside-${language}.png`) });
  });
}

await check('nothing is fetched from elsewhere, and nothing complains', async () => {
  ensure([...hosts].every((host) => host === `127.0.0.1:${stage.port}`), [...hosts].join(', '));
  ensure(complaints.length === 0, complaints.join('; '));
});

await context.close();
await finish();
