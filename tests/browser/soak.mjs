// node soak.mjs RECORDING [HOURS] [SPEED] [FACTOR]: hours of telemetry from a recording that is played again and again at many
// times its speed. After the first five minutes the memory of the server and the heap of the page may not grow by 5 %.
// By hand: docent simulate --hours 0.15 --crowd busy --record run.mcap, then node soak.mjs run.mcap.
import { join } from 'node:path';
import { answers, browse, build, check, ensure, finish, freePort, pause, root, start, temporaryFolder } from './harness.mjs';

const [recording, hours = '24', speed = '100', growth = '1.05'] = process.argv.slice(2);
const port = String(await freePort());
const stage = start(join(build, 'tests', 'web_stage', 'docent_web_soak'), [recording, join(root, 'museums', 'bonn'), temporaryFolder('soak'), port, speed]);
const url = `http://127.0.0.1:${port}/`;
await answers(url, 60000);
const { page, context, complaints } = await browse();
await page.goto(url);
await page.waitForSelector('[data-connection=open]');
const devtools = await context.newCDPSession(page);
async function heap() {
  await devtools.send('HeapProfiler.collectGarbage');
  return (await devtools.send('Runtime.getHeapUsage')).usedSize / 1024;
}
/** Virtual time [h] and memory of the server [kB]. */
const server = () => {
  const lines = stage.output.trim().split('\n');
  const [time, memory] = (lines.findLast?.((line) => /^[\d.]+ \d+$/.test(line)) ?? '0 0').split(' ').map(Number);
  return { time, memory };
};
const samples = [];
const begun = Date.now();
while (server().time < Number(hours)) {
  await pause(5000);
  ensure(stage.code === null, `the server ended: ${stage.output.slice(-300)}`);
  stage.output = stage.output.slice(-2000);
  const { time, memory } = server();
  samples.push({ time, memory, heap: await heap() });
  if (samples.length % 12 === 0) console.log(`        ${time.toFixed(2)} h: server ${memory} kB, heap ${samples[samples.length - 1].heap.toFixed(0)} kB`);
}
const seconds = (Date.now() - begun) / 1000;
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
// Five minutes of wall time, or a third of a short trial.
const first = Math.min(60, Math.floor(samples.length / 3));
for (const [name, key] of [['memory of the server', 'memory'], ['heap of the page', 'heap']]) {
  await check(`the ${name} does not grow in ${hours} h`, async () => {
    const before = median(samples.slice(first, first + 6).map((sample) => sample[key]));
    const after = median(samples.slice(-6).map((sample) => sample[key]));
    console.log(`        ${before.toFixed(0)} kB, then ${after.toFixed(0)} kB (${((100 * after) / before - 100).toFixed(1)} %), ${seconds.toFixed(0)} s of wall time`);
    ensure(after < Number(growth) * before, `${before} to ${after} kB`);
  });
}
await check('the page still shows the robot', async () => {
  ensure((await page.locator('[data-connection=open]').count()) === 1, 'no line');
  ensure(complaints.length === 0, complaints.slice(0, 3).join('\n'));
});
await finish();
