// Why the robot does what it does, in the order in which it matters to whoever is responsible for it: what stops it first, then
// what it waits for, then what it is at. Pure, so that each situation can be tested.
import type { Avoid, HealthMessage, HoursMessage, MissionMessage, OperationMessage, Reason } from '../lib/protocol';

export interface Seen {
  /** The operators' line and the visitors'. */
  isOpen: boolean;
  operation: OperationMessage | null;
  mission: MissionMessage | null;
  hours: HoursMessage | null;
  health: HealthMessage | null;
  avoid: Avoid | null;
  localized: boolean;
  isMoving: boolean;
  /** 0..1 */
  battery: number | null;
}
export type Why =
  | 'noLine' | 'stopped' | 'broken' | 'waking' | 'lost' | 'steered' | 'held' | 'charging' | 'telling' | 'asking' | 'driving'
  | 'homeward' | 'closed' | 'webHours' | 'idle';
export interface Standing {
  why: Why;
  /** A person, parts of the robot, or an exhibit's id. */
  about: string;
  /** What holds it up, as the robot says it. */
  reason: Reason | null;
  /** bad: somebody has to do something; held: it will pass; well. */
  mood: 'bad' | 'held' | 'well';
}

/** Without one of these it does not drive. */
const NEEDED = ['robot', 'avoid', 'hazards', 'localize', 'plan', 'executive', 'mission'];
/** Below this charge [0..1] the battery is news. */
export const LOW_BATTERY = 0.2;

export function standingOf(seen: Seen): Standing {
  const say = (why: Why, mood: Standing['mood'], about = '', reason: Reason | null = null): Standing => ({ why, about, reason, mood });
  const { operation, mission, avoid } = seen;
  if (!seen.isOpen) return say('noLine', 'bad');
  if (operation?.stopped) return say('stopped', 'bad', operation.stopped_by);
  const broken = (seen.health?.modules ?? []).filter((one) => NEEDED.includes(one.name) && ['faulted', 'silent'].includes(one.state));
  if (broken.length > 0) return say('broken', 'bad', broken.map((one) => one.name).join(' '));
  if (operation?.holder) return say('steered', 'held', operation.holder, seen.isMoving ? null : (avoid?.reason ?? null));
  const phase = mission?.phase ?? 'waking';
  if (phase === 'waking') return say('waking', 'held');
  if (phase === 'relocalizing' || !seen.localized) return say('lost', 'held');
  if (phase === 'charging') return say('charging', 'well', '', avoid?.reason ?? null);
  if (phase === 'explaining') return say('telling', 'well', mission?.exhibit);
  if (phase === 'asking') return say('asking', 'well', mission?.exhibit);
  if (phase === 'driving' || phase === 'going_home') {
    const isHeld = !seen.isMoving && !!avoid?.reason;
    if (isHeld) return say('held', 'held', mission?.exhibit, avoid!.reason);
    return say(phase === 'driving' ? 'driving' : 'homeward', 'well', mission?.exhibit);
  }
  if (seen.hours && (seen.hours.mode === 'closed' || !seen.hours.is_open)) return say('closed', 'well');
  if (seen.hours?.mode === 'web') return say('webHours', 'well');
  return say('idle', 'well');
}
/** Parts of the robot that work, but not as they should. */
export const ailing = (health: HealthMessage | null) => (health?.modules ?? []).filter((one) => ['degraded', 'faulted', 'silent'].includes(one.state));
