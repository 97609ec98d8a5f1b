// What the server sends and takes. docent_web_contract writes this file from documents.h and client_message.h in
// src/docent/telepresence: change those, and run it.

export interface MapPicture {
  url: string;
  columns: number;
  rows: number;
  resolution: number;
  origin: [number, number];
}
export interface Hazard {
  id: string;
  kind: 'glass' | 'plate' | 'stairs' | 'other';
  polygon: [number, number][];
}
export interface Link {
  title: Record<string, string>;
  url: string;
}
export interface Exhibit {
  id: string;
  title: Record<string, string>;
  pose: [number, number, number];
  look_at: [number, number];
  viewpoints: [number, number, number][];
  short: Record<string, string>;
  long: Record<string, string>;
  topics: string[];
  web_only: boolean;
  picture: string;
  links: Link[];
}
export interface Tour {
  id: string;
  title: Record<string, string>;
  exhibits: string[];
  minutes: number | null;
  daily: string[];
}
export interface Room {
  id: string;
  name: Record<string, string>;
  at: [number, number];
  next: string[];
}
export interface Door {
  at: [number, number];
  width: number;
  between: string[];
}
export interface Museum {
  name: Record<string, string>;
  languages: string[];
  area: [number, number][];
  home: [number, number, number];
  charger: [number, number, number] | null;
  robot_radius: number;
  map: MapPicture;
  hazards: Hazard[];
  exhibits: Exhibit[];
  tours: Tour[];
  rooms: Room[];
  doors: Door[];
}
export interface Scan {
  frame: 'map' | 'base';
  from: [number, number];
  points: number[];
}
export interface Reason {
  word: 'no_such_exhibit' | 'no_such_viewpoint' | 'no_such_tour' | 'no_such_request' | 'not_understood' | 'for_web_only' | 'web_only_now' | 'closed' | 'too_many_wait' | 'too_many_points' | 'only_in_web_hours' | 'no_such_room' | 'not_on_free_floor' | 'not_stored' | 'question_over' | 'no_such_answer' | 'busy' | 'too_fast' | 'charging_first' | 'on_the_way' | 'joins_tour' | 'tour_begun' | 'cancelled' | 'gone' | 'not_reached' | 'battery_low' | 'took_too_long' | 'no_way' | 'way_blocked' | 'unknown_task' | 'person_in_way' | 'obstacle_in_way' | 'hazard_in_way' | 'border_in_way' | 'people_near' | 'touched' | 'felt_thing_near' | 'braking' | 'border_near' | 'hazard_near' | 'obstacle_near' | 'stopped_by_hand' | 'steered_by_hand' | 'no_lease' | 'stop_unconfirmed' | 'another_stop' | 'charger_occupied' | 'charger_no_current';
  about: string;
}
export interface Avoid {
  state: string;
  reason: Reason | null;
  cap: number;
  blocked: boolean;
  person: boolean;
  real: number | null;
  virtual: number | null;
}
export interface LiveMessage {
  type: 'live';
  t: number;
  pose: [number, number, number] | null;
  v: number;
  w: number;
  p_lost: number;
  hypotheses: [number, number, number, number][];
  scan: Scan;
  people: [number, number, number, number, number][];
  avoid?: Avoid;
  battery?: number;
}
export interface PoseMessage {
  type: 'pose';
  t: number;
  pose: [number, number, number] | null;
  v: number;
  w: number;
  p_lost: number;
  battery?: number;
}
export interface BeliefHypothesis {
  pose: [number, number, number];
  mass: number;
  xx: number;
  xy: number;
  yy: number;
}
export interface Raster {
  x: number;
  y: number;
  cell: number;
  columns: number;
  rows: number;
  levels: string;
}
export interface BeliefMessage {
  type: 'belief';
  t: number;
  localized: boolean;
  p_lost: number;
  entropy: number;
  active: number;
  beams: [number, number];
  hypotheses: BeliefHypothesis[];
  raster: Raster;
}
export interface PathMessage {
  type: 'path';
  points: number[];
  goal: string;
  state: string;
  remaining: number;
  blocked: number;
}
export interface Prompt {
  id: string;
  text: Record<string, string>;
  language: string;
  options: string[];
  default: string;
  deadline: number;
}
export interface MissionMessage {
  type: 'mission';
  phase: string;
  tour: string;
  exhibit: string;
  text: Record<string, string>;
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
export interface HornMessage {
  type: 'horn';
  t: number;
  duration: number;
  audio: string;
}
export interface SoundMessage {
  type: 'sound';
  volume: number;
  music: string;
  music_volume: number;
  start: number;
}
export interface ExpressionMessage {
  type: 'expression';
  mood: 'neutral' | 'happy' | 'sad' | 'angry';
  valence: number;
  is_speaking: boolean;
  gaze: string;
  pan: number;
  tilt: number;
}
export interface ButtonMessage {
  type: 'button';
  t: number;
  number: number;
}
export interface BoardEntry {
  key: string;
  source: string;
  visitor: string;
  kind: string;
  target: string;
  viewpoint: number;
  state: string;
  reason: Reason | null;
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
export interface VotesMessage {
  type: 'votes';
  round: string;
  tours: [string, number][];
}
export interface HoursMessage {
  type: 'hours';
  mode: string;
  is_open: boolean;
  next_mode: string;
  next_at: string;
}
export interface FieldMessage {
  type: 'field';
  virtual: number[];
  beams: number[];
}
export interface MapsMessage {
  type: 'maps';
  value: Raster;
  live: Raster;
}
export interface ExplorationMessage {
  type: 'exploration';
  state: string;
  order: string;
  known_m2: number;
  way_m: number;
  frontier: number;
  unreached: [number, number][];
  warning: string;
  map: MapPicture | null;
}
export interface LogLine {
  t: number;
  kind: string;
  subject: string;
  detail: string;
}
export interface LogMessage {
  type: 'log';
  lines: LogLine[];
}
export interface OperationMessage {
  type: 'operation';
  holder: string;
  pressed: boolean;
  stopped: boolean;
  stopped_by: string;
  stop_number: number;
  hours: string;
}
export interface ModuleState {
  name: string;
  state: string;
  reason: string;
  p99_ms: number | null;
}
export interface HealthMessage {
  type: 'health';
  viewers: number;
  modules: ModuleState[];
}
export interface WindowMessage {
  type: 'window';
  v: number;
  w: number;
  candidates: number[];
}
export interface Acknowledgement {
  type: 'ack';
  id: string;
}
export interface Refusal {
  type: 'refused';
  id: string;
  reason: Reason;
}
export interface ErrorMessage {
  type: 'error';
  reason: Reason;
}
export interface Fault {
  reason: 'not_found' | 'wrong_method' | 'not_understood' | 'too_large' | 'too_fast' | 'not_allowed' | 'other_site' | 'wrong_csrf' | 'wrong_password' | 'sent_away' | 'too_often' | 'name_taken' | 'nothing_said' | 'not_stored' | 'must_stand' | 'outdated' | 'busy';
  about: string;
}
export interface Me {
  name: string;
  rank: 'viewer' | 'visitor' | 'moderator' | 'operator';
  csrf: string;
  expires: number;
}
export interface ForumThread {
  id: string;
  title: string;
  name: string;
  written: number;
  latest: number;
  posts: number;
  rank: 'viewer' | 'visitor' | 'moderator' | 'operator';
}
export interface ForumThreads {
  threads: ForumThread[];
  is_last: boolean;
}
export interface ForumPost {
  id: string;
  thread: string;
  name: string;
  title: string;
  text: string;
  written: number;
  state: 'held' | 'shown' | 'hidden';
  reports: number;
  is_own: boolean;
  rank: 'viewer' | 'visitor' | 'moderator' | 'operator';
}
export interface ForumPosts {
  posts: ForumPost[];
  is_last: boolean;
}
export interface PostWritten {
  state: 'held' | 'shown' | 'hidden';
}
export interface AuditLine {
  time: number;
  who: string;
  what: string;
  about: string;
  address: string;
  count: number;
}
export interface AuditLines {
  lines: AuditLine[];
  next: string;
}
export interface StatisticsDay {
  day: string;
  mode: string;
  web_visitors: number;
  counts: Record<string, number>;
}
export interface TourStopCount {
  day: string;
  mode: string;
  tour_began: number;
  tour: string;
  stop: number;
  exhibit: string;
  people: number;
}
export interface StatisticsDays {
  days: StatisticsDay[];
  attendance: TourStopCount[];
}
export interface AccountLine {
  name: string;
  rank: 'viewer' | 'visitor' | 'moderator' | 'operator';
  created: number;
}
export interface AccountLines {
  accounts: AccountLine[];
}
export interface RoomName {
  id: string;
  name: Record<string, string>;
  at: [number, number];
}
export interface OpeningHours {
  open: string[];
  web: string[];
  closed: string[];
}
export interface MuseumDraft {
  area: [number, number][];
  hazards: Hazard[];
  home: [number, number, number];
  charger: [number, number, number] | null;
  exhibits: Exhibit[];
  tours: Tour[];
  rooms: RoomName[];
  hours: OpeningHours;
}
export interface MuseumEdition {
  revision: string;
  is_trial: boolean;
  draft: MuseumDraft;
}
export interface MuseumWish {
  revision: string;
  draft: MuseumDraft;
}
export interface MuseumFaults {
  faults: string[];
}
export interface KeptPicture {
  picture: string;
  faults: string[];
}
export interface Recording {
  file: string;
  language: string;
  text: string;
  is_recorded: boolean;
}
export interface MuseumRecordings {
  recordings: Recording[];
  lines: number;
  strays: string[];
}
export interface SetupState {
  step: 'name' | 'map' | 'hazards' | 'exhibits' | 'check' | 'tour' | 'done';
  name: string;
  languages: string[];
  has_explored: boolean;
}
export interface SetupName {
  name: string;
  languages: string[];
}
export interface SetupOrder {
  order: 'wait' | 'by_itself' | 'by_hand' | 'finish';
}
export interface SetupWish {
  step: 'name' | 'map' | 'hazards' | 'exhibits' | 'check' | 'tour' | 'done';
}
export interface RequestMessage {
  type: 'request';
  id: string;
  kind: 'exhibit' | 'tour' | 'cancel' | 'point' | 'room' | 'skip';
  target: string;
  viewpoint: number;
  name: string;
  language: string;
}
export interface CancelMessage {
  type: 'cancel';
  id: string;
  request: string;
}
export interface ChoiceMessage {
  type: 'choice';
  id: string;
  prompt: string;
  choice: string;
}
export interface VoteMessage {
  type: 'vote';
  id: string;
  voter: string;
  tour: string;
}
export interface WatchMessage {
  type: 'watch';
  details: boolean;
  thin: boolean;
}
export interface LampsMessage {
  type: 'lamps';
  lit: number[];
}
export interface HelpMessage {
  type: 'help';
  id: string;
  language: string;
}
export interface SkipMessage {
  type: 'skip';
  id: string;
  exhibit: string;
}
export interface AnswerMessage {
  type: 'answer';
  id: string;
  question: 'liked' | 'satisfied' | 'price' | 'intelligence';
  answer: 'yes' | 'undecided' | 'no' | 'human' | 'monkey' | 'dog' | 'fish' | 'amoeba';
  language: string;
}
export interface LeaseMessage {
  type: 'lease';
  id: string;
  wants: boolean;
}
export interface SteerMessage {
  type: 'steer';
  pressed: boolean;
  forward: number;
  turn: number;
}
export interface StopMessage {
  type: 'stop';
  id: string;
  stopped: boolean;
  number: number;
}
export interface SetHoursMessage {
  type: 'set_hours';
  id: string;
  mode: 'open' | 'web' | 'closed' | 'hours';
}
export type ServerMessage = LiveMessage | PoseMessage | BeliefMessage | PathMessage | MissionMessage | SpeechMessage | HornMessage | SoundMessage | ExpressionMessage | ButtonMessage | BoardMessage | VotesMessage | HoursMessage | FieldMessage | MapsMessage | ExplorationMessage | LogMessage | OperationMessage | HealthMessage | WindowMessage | Acknowledgement | Refusal | ErrorMessage;
export type ClientMessage = RequestMessage | CancelMessage | ChoiceMessage | VoteMessage | WatchMessage | LampsMessage | HelpMessage | SkipMessage | AnswerMessage | LeaseMessage | SteerMessage | StopMessage | SetHoursMessage;
export const documents = {
  "AccountLine": {
    "fields": {
      "created": "number",
      "name": "string",
      "rank": {
        "words": [
          "viewer",
          "visitor",
          "moderator",
          "operator"
        ]
      }
    },
    "maybe": {}
  },
  "AccountLines": {
    "fields": {
      "accounts": {
        "list": {
          "document": "AccountLine"
        }
      }
    },
    "maybe": {}
  },
  "Acknowledgement": {
    "fields": {
      "id": "string"
    },
    "maybe": {},
    "type": "ack"
  },
  "AnswerMessage": {
    "fields": {
      "answer": {
        "words": [
          "yes",
          "undecided",
          "no",
          "human",
          "monkey",
          "dog",
          "fish",
          "amoeba"
        ]
      },
      "id": "string",
      "language": "string",
      "question": {
        "words": [
          "liked",
          "satisfied",
          "price",
          "intelligence"
        ]
      }
    },
    "maybe": {},
    "type": "answer"
  },
  "AuditLine": {
    "fields": {
      "about": "string",
      "address": "string",
      "count": "number",
      "time": "number",
      "what": "string",
      "who": "string"
    },
    "maybe": {}
  },
  "AuditLines": {
    "fields": {
      "lines": {
        "list": {
          "document": "AuditLine"
        }
      },
      "next": "string"
    },
    "maybe": {}
  },
  "Avoid": {
    "fields": {
      "blocked": "boolean",
      "cap": "number",
      "person": "boolean",
      "real": {
        "nullable": "number"
      },
      "reason": {
        "nullable": {
          "document": "Reason"
        }
      },
      "state": "string",
      "virtual": {
        "nullable": "number"
      }
    },
    "maybe": {}
  },
  "BeliefHypothesis": {
    "fields": {
      "mass": "number",
      "pose": {
        "tuple": [
          "number",
          "number",
          "number"
        ]
      },
      "xx": "number",
      "xy": "number",
      "yy": "number"
    },
    "maybe": {}
  },
  "BeliefMessage": {
    "fields": {
      "active": "number",
      "beams": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "entropy": "number",
      "hypotheses": {
        "list": {
          "document": "BeliefHypothesis"
        }
      },
      "localized": "boolean",
      "p_lost": "number",
      "raster": {
        "document": "Raster"
      },
      "t": "number"
    },
    "maybe": {},
    "type": "belief"
  },
  "BoardEntry": {
    "fields": {
      "changed": "number",
      "created": "number",
      "key": "string",
      "kind": "string",
      "reason": {
        "nullable": {
          "document": "Reason"
        }
      },
      "source": "string",
      "state": "string",
      "target": "string",
      "viewpoint": "number",
      "visitor": "string"
    },
    "maybe": {}
  },
  "BoardMessage": {
    "fields": {
      "closed": {
        "list": {
          "document": "BoardEntry"
        }
      },
      "open": {
        "list": {
          "document": "BoardEntry"
        }
      },
      "open_count": "number",
      "revision": "number"
    },
    "maybe": {},
    "type": "board"
  },
  "ButtonMessage": {
    "fields": {
      "number": "number",
      "t": "number"
    },
    "maybe": {},
    "type": "button"
  },
  "CancelMessage": {
    "fields": {
      "id": "string",
      "request": "string"
    },
    "maybe": {},
    "type": "cancel"
  },
  "ChoiceMessage": {
    "fields": {
      "choice": "string",
      "id": "string",
      "prompt": "string"
    },
    "maybe": {},
    "type": "choice"
  },
  "Door": {
    "fields": {
      "at": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "between": {
        "list": "string"
      },
      "width": "number"
    },
    "maybe": {}
  },
  "ErrorMessage": {
    "fields": {
      "reason": {
        "document": "Reason"
      }
    },
    "maybe": {},
    "type": "error"
  },
  "Exhibit": {
    "fields": {
      "id": "string",
      "links": {
        "list": {
          "document": "Link"
        }
      },
      "long": {
        "map": "string"
      },
      "look_at": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "picture": "string",
      "pose": {
        "tuple": [
          "number",
          "number",
          "number"
        ]
      },
      "short": {
        "map": "string"
      },
      "title": {
        "map": "string"
      },
      "topics": {
        "list": "string"
      },
      "viewpoints": {
        "list": {
          "tuple": [
            "number",
            "number",
            "number"
          ]
        }
      },
      "web_only": "boolean"
    },
    "maybe": {}
  },
  "ExplorationMessage": {
    "fields": {
      "frontier": "number",
      "known_m2": "number",
      "map": {
        "nullable": {
          "document": "MapPicture"
        }
      },
      "order": "string",
      "state": "string",
      "unreached": {
        "list": {
          "tuple": [
            "number",
            "number"
          ]
        }
      },
      "warning": "string",
      "way_m": "number"
    },
    "maybe": {},
    "type": "exploration"
  },
  "ExpressionMessage": {
    "fields": {
      "gaze": "string",
      "is_speaking": "boolean",
      "mood": {
        "words": [
          "neutral",
          "happy",
          "sad",
          "angry"
        ]
      },
      "pan": "number",
      "tilt": "number",
      "valence": "number"
    },
    "maybe": {},
    "type": "expression"
  },
  "Fault": {
    "fields": {
      "about": "string",
      "reason": {
        "words": [
          "not_found",
          "wrong_method",
          "not_understood",
          "too_large",
          "too_fast",
          "not_allowed",
          "other_site",
          "wrong_csrf",
          "wrong_password",
          "sent_away",
          "too_often",
          "name_taken",
          "nothing_said",
          "not_stored",
          "must_stand",
          "outdated",
          "busy"
        ]
      }
    },
    "maybe": {}
  },
  "FieldMessage": {
    "fields": {
      "beams": {
        "list": "number"
      },
      "virtual": {
        "list": "number"
      }
    },
    "maybe": {},
    "type": "field"
  },
  "ForumPost": {
    "fields": {
      "id": "string",
      "is_own": "boolean",
      "name": "string",
      "rank": {
        "words": [
          "viewer",
          "visitor",
          "moderator",
          "operator"
        ]
      },
      "reports": "number",
      "state": {
        "words": [
          "held",
          "shown",
          "hidden"
        ]
      },
      "text": "string",
      "thread": "string",
      "title": "string",
      "written": "number"
    },
    "maybe": {}
  },
  "ForumPosts": {
    "fields": {
      "is_last": "boolean",
      "posts": {
        "list": {
          "document": "ForumPost"
        }
      }
    },
    "maybe": {}
  },
  "ForumThread": {
    "fields": {
      "id": "string",
      "latest": "number",
      "name": "string",
      "posts": "number",
      "rank": {
        "words": [
          "viewer",
          "visitor",
          "moderator",
          "operator"
        ]
      },
      "title": "string",
      "written": "number"
    },
    "maybe": {}
  },
  "ForumThreads": {
    "fields": {
      "is_last": "boolean",
      "threads": {
        "list": {
          "document": "ForumThread"
        }
      }
    },
    "maybe": {}
  },
  "Hazard": {
    "fields": {
      "id": "string",
      "kind": {
        "words": [
          "glass",
          "plate",
          "stairs",
          "other"
        ]
      },
      "polygon": {
        "list": {
          "tuple": [
            "number",
            "number"
          ]
        }
      }
    },
    "maybe": {}
  },
  "HealthMessage": {
    "fields": {
      "modules": {
        "list": {
          "document": "ModuleState"
        }
      },
      "viewers": "number"
    },
    "maybe": {},
    "type": "health"
  },
  "HelpMessage": {
    "fields": {
      "id": "string",
      "language": "string"
    },
    "maybe": {},
    "type": "help"
  },
  "HornMessage": {
    "fields": {
      "audio": "string",
      "duration": "number",
      "t": "number"
    },
    "maybe": {},
    "type": "horn"
  },
  "HoursMessage": {
    "fields": {
      "is_open": "boolean",
      "mode": "string",
      "next_at": "string",
      "next_mode": "string"
    },
    "maybe": {},
    "type": "hours"
  },
  "KeptPicture": {
    "fields": {
      "faults": {
        "list": "string"
      },
      "picture": "string"
    },
    "maybe": {}
  },
  "LampsMessage": {
    "fields": {
      "lit": {
        "list": "number"
      }
    },
    "maybe": {},
    "type": "lamps"
  },
  "LeaseMessage": {
    "fields": {
      "id": "string",
      "wants": "boolean"
    },
    "maybe": {},
    "type": "lease"
  },
  "Link": {
    "fields": {
      "title": {
        "map": "string"
      },
      "url": "string"
    },
    "maybe": {}
  },
  "LiveMessage": {
    "fields": {
      "hypotheses": {
        "list": {
          "tuple": [
            "number",
            "number",
            "number",
            "number"
          ]
        }
      },
      "p_lost": "number",
      "people": {
        "list": {
          "tuple": [
            "number",
            "number",
            "number",
            "number",
            "number"
          ]
        }
      },
      "pose": {
        "nullable": {
          "tuple": [
            "number",
            "number",
            "number"
          ]
        }
      },
      "scan": {
        "document": "Scan"
      },
      "t": "number",
      "v": "number",
      "w": "number"
    },
    "maybe": {
      "avoid": {
        "document": "Avoid"
      },
      "battery": "number"
    },
    "type": "live"
  },
  "LogLine": {
    "fields": {
      "detail": "string",
      "kind": "string",
      "subject": "string",
      "t": "number"
    },
    "maybe": {}
  },
  "LogMessage": {
    "fields": {
      "lines": {
        "list": {
          "document": "LogLine"
        }
      }
    },
    "maybe": {},
    "type": "log"
  },
  "MapPicture": {
    "fields": {
      "columns": "number",
      "origin": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "resolution": "number",
      "rows": "number",
      "url": "string"
    },
    "maybe": {}
  },
  "MapsMessage": {
    "fields": {
      "live": {
        "document": "Raster"
      },
      "value": {
        "document": "Raster"
      }
    },
    "maybe": {},
    "type": "maps"
  },
  "Me": {
    "fields": {
      "csrf": "string",
      "expires": "number",
      "name": "string",
      "rank": {
        "words": [
          "viewer",
          "visitor",
          "moderator",
          "operator"
        ]
      }
    },
    "maybe": {}
  },
  "MissionMessage": {
    "fields": {
      "agenda": {
        "list": "string"
      },
      "exhibit": "string",
      "explained": "number",
      "phase": "string",
      "prompt": {
        "nullable": {
          "document": "Prompt"
        }
      },
      "served": "number",
      "text": {
        "map": "string"
      },
      "tour": "string",
      "tours": "number"
    },
    "maybe": {},
    "type": "mission"
  },
  "ModuleState": {
    "fields": {
      "name": "string",
      "p99_ms": {
        "nullable": "number"
      },
      "reason": "string",
      "state": "string"
    },
    "maybe": {}
  },
  "Museum": {
    "fields": {
      "area": {
        "list": {
          "tuple": [
            "number",
            "number"
          ]
        }
      },
      "charger": {
        "nullable": {
          "tuple": [
            "number",
            "number",
            "number"
          ]
        }
      },
      "doors": {
        "list": {
          "document": "Door"
        }
      },
      "exhibits": {
        "list": {
          "document": "Exhibit"
        }
      },
      "hazards": {
        "list": {
          "document": "Hazard"
        }
      },
      "home": {
        "tuple": [
          "number",
          "number",
          "number"
        ]
      },
      "languages": {
        "list": "string"
      },
      "map": {
        "document": "MapPicture"
      },
      "name": {
        "map": "string"
      },
      "robot_radius": "number",
      "rooms": {
        "list": {
          "document": "Room"
        }
      },
      "tours": {
        "list": {
          "document": "Tour"
        }
      }
    },
    "maybe": {}
  },
  "MuseumDraft": {
    "fields": {
      "area": {
        "list": {
          "tuple": [
            "number",
            "number"
          ]
        }
      },
      "charger": {
        "nullable": {
          "tuple": [
            "number",
            "number",
            "number"
          ]
        }
      },
      "exhibits": {
        "list": {
          "document": "Exhibit"
        }
      },
      "hazards": {
        "list": {
          "document": "Hazard"
        }
      },
      "home": {
        "tuple": [
          "number",
          "number",
          "number"
        ]
      },
      "hours": {
        "document": "OpeningHours"
      },
      "rooms": {
        "list": {
          "document": "RoomName"
        }
      },
      "tours": {
        "list": {
          "document": "Tour"
        }
      }
    },
    "maybe": {}
  },
  "MuseumEdition": {
    "fields": {
      "draft": {
        "document": "MuseumDraft"
      },
      "is_trial": "boolean",
      "revision": "string"
    },
    "maybe": {}
  },
  "MuseumFaults": {
    "fields": {
      "faults": {
        "list": "string"
      }
    },
    "maybe": {}
  },
  "MuseumRecordings": {
    "fields": {
      "lines": "number",
      "recordings": {
        "list": {
          "document": "Recording"
        }
      },
      "strays": {
        "list": "string"
      }
    },
    "maybe": {}
  },
  "MuseumWish": {
    "fields": {
      "draft": {
        "document": "MuseumDraft"
      },
      "revision": "string"
    },
    "maybe": {}
  },
  "OpeningHours": {
    "fields": {
      "closed": {
        "list": "string"
      },
      "open": {
        "list": "string"
      },
      "web": {
        "list": "string"
      }
    },
    "maybe": {}
  },
  "OperationMessage": {
    "fields": {
      "holder": "string",
      "hours": "string",
      "pressed": "boolean",
      "stop_number": "number",
      "stopped": "boolean",
      "stopped_by": "string"
    },
    "maybe": {},
    "type": "operation"
  },
  "PathMessage": {
    "fields": {
      "blocked": "number",
      "goal": "string",
      "points": {
        "list": "number"
      },
      "remaining": "number",
      "state": "string"
    },
    "maybe": {},
    "type": "path"
  },
  "PoseMessage": {
    "fields": {
      "p_lost": "number",
      "pose": {
        "nullable": {
          "tuple": [
            "number",
            "number",
            "number"
          ]
        }
      },
      "t": "number",
      "v": "number",
      "w": "number"
    },
    "maybe": {
      "battery": "number"
    },
    "type": "pose"
  },
  "PostWritten": {
    "fields": {
      "state": {
        "words": [
          "held",
          "shown",
          "hidden"
        ]
      }
    },
    "maybe": {}
  },
  "Prompt": {
    "fields": {
      "deadline": "number",
      "default": "string",
      "id": "string",
      "language": "string",
      "options": {
        "list": "string"
      },
      "text": {
        "map": "string"
      }
    },
    "maybe": {}
  },
  "Raster": {
    "fields": {
      "cell": "number",
      "columns": "number",
      "levels": "string",
      "rows": "number",
      "x": "number",
      "y": "number"
    },
    "maybe": {}
  },
  "Reason": {
    "fields": {
      "about": "string",
      "word": {
        "words": [
          "no_such_exhibit",
          "no_such_viewpoint",
          "no_such_tour",
          "no_such_request",
          "not_understood",
          "for_web_only",
          "web_only_now",
          "closed",
          "too_many_wait",
          "too_many_points",
          "only_in_web_hours",
          "no_such_room",
          "not_on_free_floor",
          "not_stored",
          "question_over",
          "no_such_answer",
          "busy",
          "too_fast",
          "charging_first",
          "on_the_way",
          "joins_tour",
          "tour_begun",
          "cancelled",
          "gone",
          "not_reached",
          "battery_low",
          "took_too_long",
          "no_way",
          "way_blocked",
          "unknown_task",
          "person_in_way",
          "obstacle_in_way",
          "hazard_in_way",
          "border_in_way",
          "people_near",
          "touched",
          "felt_thing_near",
          "braking",
          "border_near",
          "hazard_near",
          "obstacle_near",
          "stopped_by_hand",
          "steered_by_hand",
          "no_lease",
          "stop_unconfirmed",
          "another_stop",
          "charger_occupied",
          "charger_no_current"
        ]
      }
    },
    "maybe": {}
  },
  "Recording": {
    "fields": {
      "file": "string",
      "is_recorded": "boolean",
      "language": "string",
      "text": "string"
    },
    "maybe": {}
  },
  "Refusal": {
    "fields": {
      "id": "string",
      "reason": {
        "document": "Reason"
      }
    },
    "maybe": {},
    "type": "refused"
  },
  "RequestMessage": {
    "fields": {
      "id": "string",
      "kind": {
        "words": [
          "exhibit",
          "tour",
          "cancel",
          "point",
          "room",
          "skip"
        ]
      },
      "language": "string",
      "name": "string",
      "target": "string",
      "viewpoint": "number"
    },
    "maybe": {},
    "type": "request"
  },
  "Room": {
    "fields": {
      "at": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "id": "string",
      "name": {
        "map": "string"
      },
      "next": {
        "list": "string"
      }
    },
    "maybe": {}
  },
  "RoomName": {
    "fields": {
      "at": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "id": "string",
      "name": {
        "map": "string"
      }
    },
    "maybe": {}
  },
  "Scan": {
    "fields": {
      "frame": {
        "words": [
          "map",
          "base"
        ]
      },
      "from": {
        "tuple": [
          "number",
          "number"
        ]
      },
      "points": {
        "list": "number"
      }
    },
    "maybe": {}
  },
  "SetHoursMessage": {
    "fields": {
      "id": "string",
      "mode": {
        "words": [
          "open",
          "web",
          "closed",
          "hours"
        ]
      }
    },
    "maybe": {},
    "type": "set_hours"
  },
  "SetupName": {
    "fields": {
      "languages": {
        "list": "string"
      },
      "name": "string"
    },
    "maybe": {}
  },
  "SetupOrder": {
    "fields": {
      "order": {
        "words": [
          "wait",
          "by_itself",
          "by_hand",
          "finish"
        ]
      }
    },
    "maybe": {}
  },
  "SetupState": {
    "fields": {
      "has_explored": "boolean",
      "languages": {
        "list": "string"
      },
      "name": "string",
      "step": {
        "words": [
          "name",
          "map",
          "hazards",
          "exhibits",
          "check",
          "tour",
          "done"
        ]
      }
    },
    "maybe": {}
  },
  "SetupWish": {
    "fields": {
      "step": {
        "words": [
          "name",
          "map",
          "hazards",
          "exhibits",
          "check",
          "tour",
          "done"
        ]
      }
    },
    "maybe": {}
  },
  "SkipMessage": {
    "fields": {
      "exhibit": "string",
      "id": "string"
    },
    "maybe": {},
    "type": "skip"
  },
  "SoundMessage": {
    "fields": {
      "music": "string",
      "music_volume": "number",
      "start": "number",
      "volume": "number"
    },
    "maybe": {},
    "type": "sound"
  },
  "SpeechMessage": {
    "fields": {
      "audio": "string",
      "duration": "number",
      "id": "string",
      "language": "string",
      "start": "number",
      "state": "string",
      "text": "string"
    },
    "maybe": {},
    "type": "speech"
  },
  "StatisticsDay": {
    "fields": {
      "counts": {
        "map": "number"
      },
      "day": "string",
      "mode": "string",
      "web_visitors": "number"
    },
    "maybe": {}
  },
  "StatisticsDays": {
    "fields": {
      "attendance": {
        "list": {
          "document": "TourStopCount"
        }
      },
      "days": {
        "list": {
          "document": "StatisticsDay"
        }
      }
    },
    "maybe": {}
  },
  "SteerMessage": {
    "fields": {
      "forward": "number",
      "pressed": "boolean",
      "turn": "number"
    },
    "maybe": {},
    "type": "steer"
  },
  "StopMessage": {
    "fields": {
      "id": "string",
      "number": "number",
      "stopped": "boolean"
    },
    "maybe": {},
    "type": "stop"
  },
  "Tour": {
    "fields": {
      "daily": {
        "list": "string"
      },
      "exhibits": {
        "list": "string"
      },
      "id": "string",
      "minutes": {
        "nullable": "number"
      },
      "title": {
        "map": "string"
      }
    },
    "maybe": {}
  },
  "TourStopCount": {
    "fields": {
      "day": "string",
      "exhibit": "string",
      "mode": "string",
      "people": "number",
      "stop": "number",
      "tour": "string",
      "tour_began": "number"
    },
    "maybe": {}
  },
  "VoteMessage": {
    "fields": {
      "id": "string",
      "tour": "string",
      "voter": "string"
    },
    "maybe": {},
    "type": "vote"
  },
  "VotesMessage": {
    "fields": {
      "round": "string",
      "tours": {
        "list": {
          "tuple": [
            "string",
            "number"
          ]
        }
      }
    },
    "maybe": {},
    "type": "votes"
  },
  "WatchMessage": {
    "fields": {
      "details": "boolean",
      "thin": "boolean"
    },
    "maybe": {},
    "type": "watch"
  },
  "WindowMessage": {
    "fields": {
      "candidates": {
        "list": "number"
      },
      "v": "number",
      "w": "number"
    },
    "maybe": {},
    "type": "window"
  }
} as const;
