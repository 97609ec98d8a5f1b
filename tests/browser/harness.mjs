// What the browser tests share: Chromium, processes that surely end, and a count of what passed.
import { spawn } from 'node:child_process';
import { mkdtempSync, mkdirSync, rmSync, existsSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const build = process.env.DOCENT_BUILD ?? join(root, 'build', 'dev');
export const pictures = process.env.DOCENT_SCREENSHOTS ?? join(build, 'screenshots');
mkdirSync(pictures, { recursive: true });

// Not that of whoever runs the tests.
process.env.DOCENT_CACHE ??= join(build, 'test-cache');

const clean = [];
export const onEnd = (action) => clean.push(action);

export function temporaryFolder(name) {
  const folder = mkdtempSync(join(tmpdir(), `docent-${name}-`));
  onEnd(() => rmSync(folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 }));
  return folder;
}

/** A port on which nobody listens now. Give `first` and `last` where a range must be kept to. */
export async function freePort() {
  return new Promise((resolve, reject) => {
    const server = createServer();
    server.once('error', reject);
    server.listen(0, '127.0.0.1', () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** What still runs; a test that breaks off leaves nothing behind either. */
const children = new Set();
process.on('exit', () => children.forEach((child) => child.kill()));

/** A child process with what it said; it is ended with the tests whatever happens. */
export function start(command, words, options = {}) {
  const child = spawn(command, words, { stdio: ['ignore', 'pipe', 'pipe'], ...options });
  const process_ = { child, output: '', code: null };
  children.add(child);
  child.once('exit', () => children.delete(child));
  child.stdout.on('data', (text) => (process_.output += text));
  child.stderr.on('data', (text) => (process_.output += text));
  process_.ended = new Promise((resolve) => {
    child.once('error', (error) => {
      process_.output += String(error);
      resolve(-1);
    });
    child.once('exit', (code) => {
      process_.code = code;
      resolve(code);
    });
  });
  process_.stop = async (signal = 'SIGTERM') => {
    if (child.exitCode === null && child.signalCode === null) {
      child.kill(signal);
      const timer = setTimeout(() => child.kill('SIGKILL'), 10000);
      await process_.ended;
      clearTimeout(timer);
    }
  };
  onEnd(() => process_.stop());
  return process_;
}

export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

export async function until(what, condition, patience = 15000, step = 100) {
  const end = Date.now() + patience;
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() > end) throw new Error(`${what}: not within ${patience / 1000} s`);
    await pause(step);
  }
}

export async function answers(url, patience = 20000) {
  await until(`${url} answers`, async () => {
    try {
      return (await fetch(url)).ok;
    } catch {
      return false;
    }
  }, patience);
}

/** In a page: it draws three times a second, not thirty, and nothing moves by itself. Most tests look at what is drawn, not
 *  at how smoothly, and drawing without a graphics card is most of what they cost: what the style sheet moves is composed
 *  sixty times a second. */
function drawRarely() {
  const still = new CSSStyleSheet();
  still.replaceSync('*, *::before, *::after { animation: none !important; transition: none !important; }');
  document.adoptedStyleSheets = [still];
  const frame = window.requestAnimationFrame.bind(window);
  const waiting = new Set();
  window.requestAnimationFrame = (draw) => {
    const id = setTimeout(() => frame((now) => waiting.delete(id) && draw(now)), 330);
    waiting.add(id);
    return id;
  };
  window.cancelAnimationFrame = (id) => {
    waiting.delete(id);
    clearTimeout(id);
  };
}

const programs = ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium', '/usr/bin/chromium-browser'];
let running;
/** The one Chromium of a file of tests, for starting it costs 3 s of processor time. It is Debian's headless shell where
 *  that is installed, which has no window to draw and costs less; the variable CHROMIUM names another program. */
function theChromium() {
  running ??= chromium.launch({
    executablePath: process.env.CHROMIUM ?? programs.find(existsSync),
    headless: true,
    args: [
      '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--autoplay-policy=no-user-gesture-required', '--mute-audio',
    ],
  }).then((browser) => {
    onEnd(() => browser.close());
    return browser;
  });
  return running;
}

/** A visitor's browser, which shares nothing with others. Every complaint of a page lands in `complaints`. `isSmooth`: it
 *  draws as often as a visitor's. */
export async function browse({ isSmooth = false, ...options } = {}) {
  const browser = await theChromium();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: 'en-US', ...options });
  onEnd(() => context.close());
  if (!isSmooth) await context.addInitScript(drawRarely);
  const complaints = [];
  const hosts = new Set();
  context.on('page', watch);
  function watch(page) {
    page.on('console', (message) => {
      if (message.type() === 'error') complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(error.message));
    page.on('request', (request) => {
      if (/^(https?|wss?):/.test(request.url())) hosts.add(new URL(request.url()).host);
    });
  }
  return { context, complaints, hosts, page: await context.newPage() };
}

/** The map of the museum editor on a page: where a place of it is, and a click there. */
export function editorMap(page) {
  const onPage = (place) => page.evaluate(([x, y]) => {
    const matrix = document.querySelector('.editor-map svg > g').getScreenCTM();
    const point = new DOMPoint(x, y).matrixTransform(matrix);
    return [point.x, point.y];
  }, place);
  return { onPage, click: async (place) => page.mouse.click(...(await onPage(place))) };
}

let passed = 0;
let failed = 0;
export async function check(name, action) {
  const begin = Date.now();
  try {
    await action();
    ++passed;
    console.log(`ok      ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
    return true;
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}: ${error.message.split('\n').slice(0, 6).join('\n        ')}`);
    return false;
  }
}
export function ensure(condition, what) {
  if (!condition) throw new Error(what);
}

/** Ends everything that was begun, prints the count, exits. */
export async function finish() {
  for (const action of clean.reverse()) {
    try {
      await action();
    } catch {
      // it is gone already
    }
  }
  console.log(`${passed} passed, ${failed} failed`);
  process.exit(failed > 0 || passed === 0 ? 1 : 0);
}
