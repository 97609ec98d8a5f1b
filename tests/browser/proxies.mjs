// Proxies before the robot's page, with the configurations that docs/proxies.md shows.
import { spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import http from 'node:http';
import https from 'node:https';
import { join } from 'node:path';
import { ensure, freePort, root, start, temporaryFolder, until } from './harness.mjs';

const place = temporaryFolder('proxies');
chmodSync(place, 0o755); // those that begin as root go on as somebody else
const page = readFileSync(join(root, 'docs', 'proxies.md'), 'utf8');
/** What the document shows in a language, one text a block. */
export const shown = (language) => [...page.matchAll(/^```(\S*)\n(.*?)^```$/gms)].filter(([, is]) => is === language).map(([, , text]) => text);
/** Exchanges what a museum exchanges: it must stand there. */
function exchange(text, ...pairs) {
  for (const [old, wanted] of pairs) {
    ensure(text.includes(old), `docs/proxies.md: no ${old}`);
    text = text.replaceAll(old, wanted);
  }
  return text;
}

/** The settings that the document names for robot.yaml, as SECTION.KEY=VALUE. */
export const settings = shown('yaml').flatMap((text) => [...text.matchAll(/^ +(\w+): (.*)$/gm)].map(([, key, value]) => `web.${key}=${value}`));

const [key, certificate] = [join(place, 'museum.key'), join(place, 'museum.pem')];
const made = spawnSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '2',
  '-subj', '/CN=museum.example', '-addext', 'subjectAltName=DNS:museum.example,IP:127.0.0.1', '-keyout', key, '-out', certificate], { encoding: 'utf8' });
ensure(made.status === 0, made.stderr);
export const ca = readFileSync(certificate);

export const PASSWORD_OF_GUIDE = 'seven halls';
/** The file of passwords, by the document's own command. */
function passwords() {
  const file = join(place, 'docent.htpasswd');
  const command = exchange(shown('sh')[0], ['/etc/nginx/docent.htpasswd', file], ['-apr1', `-apr1 '${PASSWORD_OF_GUIDE}'`]);
  const done = spawnSync('sh', ['-ec', command], { encoding: 'utf8' });
  ensure(done.status === 0, done.stderr);
  return file;
}

async function listens(name, server, url) {
  await until(`${name} listens`, async () => {
    ensure(server.code === null, `${name}: ${server.output}`);
    return ask(url).then(({ status }) => status === 200, () => false);
  }, 20000, 30);
  return url;
}

/** nginx before a robot: where its page is by https, with the path taken away, and where with the path passed on. */
export async function nginx(robot) {
  const [taken, passed] = [await freePort(), await freePort()];
  const [text, inside] = shown('nginx');
  const [map, server] = text.split(/^(?=server)/m);
  const whole = exchange(server, ['127.0.0.1:8080', `127.0.0.1:${robot}`], ['/etc/ssl/certs/museum.pem', certificate], ['/etc/ssl/private/museum.key', key],
    ['  }\n}', `${exchange(inside, ['127.0.0.1:8080', `127.0.0.1:${robot}`], ['/etc/nginx/docent.htpasswd', passwords()])}  }\n}`]);
  const servers = exchange(whole, ['listen 443 ssl', `listen 127.0.0.1:${taken} ssl`]) +
    exchange(whole, ['listen 443 ssl', `listen 127.0.0.1:${passed}`], [`${robot}/;`, `${robot};`]).replace(/^.*(ssl_|Forwarded-Prefix).*\n/gm, '');
  const temporary = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((kind) => `${kind}_temp_path ${join(place, kind)};`).join('\n');
  const file = join(place, 'nginx.conf');
  writeFileSync(file, `daemon off; pid ${join(place, 'nginx.pid')}; error_log stderr; worker_processes 1; events {}
    http { access_log off; ${temporary}\n${map}${servers}}`);
  const process_ = start('/usr/sbin/nginx', ['-c', file, '-p', place, '-e', 'stderr']);
  return {
    taken: await listens('nginx', process_, `https://127.0.0.1:${taken}/robot/`),
    passed: await listens('nginx', process_, `http://127.0.0.1:${passed}/robot/`),
  };
}

/** Apache before a robot. */
export async function apache(robot) {
  const port = await freePort();
  const modules = ['mpm_event', 'authz_core', 'alias', 'headers', 'proxy', 'proxy_http'].map((name) => `LoadModule ${name}_module /usr/lib/apache2/modules/mod_${name}.so`);
  const file = join(place, 'apache.conf');
  const own = join(place, 'apache');
  mkdirSync(own);
  const user = process.getuid() === 0 ? 'User nobody\nGroup nogroup\n' : '';
  writeFileSync(file, `${modules.join('\n')}\nListen 127.0.0.1:${port}\nServerName museum.example\nServerRoot ${own}\nDefaultRuntimeDir ${own}\n` +
    `PidFile ${join(own, 'pid')}\nErrorLog ${join(own, 'error.log')}\n${user}<VirtualHost *:${port}>\n${exchange(shown('apache')[0], ['127.0.0.1:8080', `127.0.0.1:${robot}`])}</VirtualHost>\n`);
  return listens('apache2', start('/usr/sbin/apache2', ['-f', file, '-D', 'FOREGROUND']), `http://127.0.0.1:${port}/robot/`);
}

/** Caddy, where somebody has it; DOCENT_CADDY names it. Else null. */
export async function caddy(robot) {
  const program = process.env.DOCENT_CADDY ?? '/usr/bin/caddy';
  if (!existsSync(program)) return null;
  const port = await freePort();
  const file = join(place, 'Caddyfile');
  const own = join(place, 'caddy');
  const text = exchange(shown('Caddyfile')[0], ['127.0.0.1:8080', `127.0.0.1:${robot}`], ['museum.example {', `http://127.0.0.1:${port} {`]);
  writeFileSync(file, `{\n  admin off\n}\n${text}`);
  const words = ['run', '--adapter', 'caddyfile', '--config', file];
  return listens('caddy', start(program, words, { env: { ...process.env, HOME: own, XDG_DATA_HOME: own, XDG_CONFIG_HOME: own } }), `http://127.0.0.1:${port}/robot/`);
}

/** A request, without following where it leads. */
export function ask(url, { method = 'GET', headers = {}, body } = {}) {
  return new Promise((resolve, reject) => {
    const text = body && JSON.stringify(body);
    const request = (url.startsWith('https') ? https : http).request(url, {
      method, ca, headers: { ...headers, ...(text && { 'Content-Type': 'application/json', 'Content-Length': Buffer.byteLength(text) }) },
    }, (reply) => {
      const parts = [];
      reply.on('data', (part) => parts.push(part));
      reply.on('end', () => resolve({ status: reply.statusCode, headers: reply.headers, bytes: Buffer.concat(parts) }));
    });
    request.on('error', reject);
    request.end(text);
  });
}
