// What the server sends and takes; src/docent/telepresence is the other side.

export type Translations = Record<string, string>;
/** x, y [m], heading [rad] in the map's frame. */
export type Pose = [number, number, number];
export type Point = [number, number];

export interface Exhibit {
  id: string;
  title: Translations;
  pose: Pose;
  look_at: Point;
  viewpoints: Pose[];
  short: Translations;
  long: Translations;
  topics: string[];
  web_only: boolean;
}
export interface Tour {
  id: string;
  title: Translations;
  exhibits: string[];
  minutes: number | null;
}
export interface Hazard {
  id: string;
  kind: 'glass' | 'plate' | 'stairs' | 'other';
  polygon: Point[];
}
export interface Museum {
  name: Translations;
  languages: string[];
  area: Point[];
  home: Pose;
  charger: Pose | null;
  robot_radius: number;
  map: { url: string; columns: number; rows: number; resolution: number; origin: Point };
  hazards: Hazard[];
  exhibits: Exhibit[];
  tours: Tour[];
}

export interface Avoid {
  state: string;
  reason: string;
  cap: number;
  blocked: boolean;
  person: boolean;
  real: number | null;
  virtual: number | null;
}
export interface LiveMessage {
  type: 'live';
  t: number;
  pose: Pose | null;
  v: number;
  w: number;
  p_lost: number;
  hypotheses: [number, number, number, number][];
  scan: { frame: 'map' | 'base'; from: Point; points: number[] };
  people: [number, number, number, number, number][];
  avoid?: Avoid;
  battery?: number;
}
export interface BeliefMessage {
  type: 'belief';
  localized: boolean;
  p_lost: number;
  entropy: number;
  active: number;
  beams: [number, number];
  hypotheses: { pose: Pose; mass: number; xx: number; xy: number; yy: number }[];
  raster: { x: number; y: number; cell: number; columns: number; rows: number; levels: string };
}
export interface PathMessage {
  type: 'path';
  points: number[];
  goal: string;
  state: string;
  remaining: number;
  blocked: number;
  reason: string;
}
export interface Prompt {
  id: string;
  text: string;
  options: string[];
  default: string;
  deadline: number;
}
export interface MissionMessage {
  type: 'mission';
  phase: string;
  tour: string;
  exhibit: string;
  text: Translations;
  agenda: string[];
  explained: number;
  tours: number;
  served: number;
  prompt: Prompt | null;
}
export interface SpeechMessage {
  type: 'speech';
  id: string;
  state: string;
  text: string;
  language: string;
  start: number;
  duration: number;
  audio: string;
}
/** The horn sounds at `t`; `audio` is empty while the robot is muted. */
export interface HornMessage {
  type: 'horn';
  t: number;
  duration: number;
  audio: string;
}
export interface BoardEntry {
  key: string;
  source: string;
  visitor: string;
  kind: string;
  target: string;
  viewpoint: number;
  state: string;
  reason: string;
  created: number;
  changed: number;
}
export interface BoardMessage {
  type: 'board';
  revision: number;
  open: BoardEntry[];
  open_count: number;
  closed: BoardEntry[];
}
export interface HealthMessage {
  type: 'health';
  viewers?: number;
  modules: { name: string; state: string; reason: string; p99_ms: number | null }[];
}
export interface WindowMessage {
  type: 'window';
  v: number;
  w: number;
  candidates: number[];
}
export type ServerMessage =
  | LiveMessage
  | BeliefMessage
  | PathMessage
  | MissionMessage
  | SpeechMessage
  | HornMessage
  | BoardMessage
  | HealthMessage
  | WindowMessage
  | { type: 'ack'; id: string }
  | { type: 'refused'; id: string; reason: string }
  | { type: 'error'; reason: string };
