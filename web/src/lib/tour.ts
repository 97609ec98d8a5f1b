// How far a tour has come and how long it takes, from what the robot says of itself and what the museum says of its tours.
import type { Exhibit, MissionMessage, Museum, Tour } from './protocol';

/** [m/s] with stops for people and turns */
export const PACE = 0.4;
/** Walls and people make the way longer than the line. */
const DETOUR = 1.3;
/** Letters a second that the voice speaks. */
const LETTERS = 14;
/** [s] in which visitors may ask for more. */
export const QUESTION = 8;

/** [m] */
export const wayBetween = (a: Exhibit, b: Exhibit) => DETOUR * Math.hypot(a.pose[0] - b.pose[0], a.pose[1] - b.pose[1]);
/** [s] the short text, spoken, with the question after it */
export const spokenLength = (exhibit: Exhibit, language: string) => {
  const text = exhibit.short[language] ?? Object.values(exhibit.short)[0] ?? '';
  return text.length / LETTERS + QUESTION;
};

/** The robot stands before stop `stop` of `stops`, or is on its way there. */
export interface Progress {
  stop: number;
  stops: number;
  /** Exhibits that are still to come in this tour. */
  next: string[];
}

/** Null: no tour is under way, or it is made up as it goes. */
export function progressOf(mission: MissionMessage | null, museum: Museum | null): Progress | null {
  const tour = museum?.tours.find((one) => one.id === mission?.tour);
  if (!mission || !tour || !tour.exhibits.includes(mission.exhibit)) return null;
  // The stops to come lead the agenda; whatever else is wished for stands behind them.
  const next: string[] = [];
  for (const id of mission.agenda) {
    if (!tour.exhibits.includes(id) || id === mission.exhibit || next.includes(id)) break;
    next.push(id);
  }
  const stops = tour.exhibits.length;
  return { stop: Math.max(1, stops - next.length), stops, next };
}

/** About how long a tour takes [min]; null: nobody can say. */
export function minutesOf(tour: Tour, museum: Museum, language: string): number | null {
  if (tour.minutes) return tour.minutes;
  const exhibits = tour.exhibits.map((id) => museum.exhibits.find((one) => one.id === id)).filter((one): one is Exhibit => !!one);
  if (exhibits.length === 0) return null;
  let seconds = 0;
  exhibits.forEach((exhibit, i) => (seconds += spokenLength(exhibit, language) + (i > 0 ? wayBetween(exhibits[i - 1], exhibit) / PACE : 0)));
  return Math.max(1, Math.round(seconds / 60));
}
