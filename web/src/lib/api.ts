// Calls to /api/v1 (docs/openapi.json).
import type { Fault, Me } from './protocol';
import { addressOf } from './site';

export type ApiFault = Fault['reason'] | 'offline';
export class ApiError extends Error {
  constructor(readonly reason: ApiFault) {
    super(reason);
  }
}

let csrf = '';

/** The reply; ApiError when it was refused, or nobody answered. */
export async function call<T>(method: 'GET' | 'POST' | 'PUT' | 'DELETE', path: string, body?: object): Promise<T> {
  const headers: Record<string, string> = {};
  if (body) headers['Content-Type'] = 'application/json';
  if (method !== 'GET' && csrf) headers['Docent-Csrf'] = csrf;
  let reply: Response;
  try {
    reply = await fetch(addressOf(`/api/v1${path}`), { method, headers, body: body && JSON.stringify(body), signal: AbortSignal.timeout(15000) });
  } catch {
    throw new ApiError('offline');
  }
  const document = await reply.json().catch(() => ({ reason: 'offline' }));
  if (!reply.ok) throw new ApiError(document.reason);
  return document;
}

/** What lies there on the server; null: nothing, or nobody answers. */
export async function fetchText(path: string): Promise<string | null> {
  try {
    const reply = await fetch(addressOf(path), { signal: AbortSignal.timeout(20000) });
    return reply.ok ? await reply.text() : null;
  } catch {
    return null;
  }
}

function know(me: Me): Me {
  csrf = me.csrf;
  return me;
}
export const whoAmI = async () => know(await call<Me>('GET', '/login'));
export const logIn = async (name: string, password: string) => know(await call<Me>('POST', '/login', { name, password }));
export const nameMyself = async (name: string) => know(await call<Me>('POST', '/visitor', { name }));
export async function logOut(): Promise<Me> {
  await call('DELETE', '/login');
  return whoAmI();
}
