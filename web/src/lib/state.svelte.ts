import { declareLanguage } from './direction';
import { RobotClock } from './clock';
import { fetchText } from './api';
import { Motion } from './motion';
import type {
  Avoid,
  BeliefMessage,
  BoardEntry,
  BoardMessage,
  ButtonMessage,
  ClientMessage,
  Exhibit,
  ExplorationMessage,
  ExpressionMessage,
  FieldMessage,
  HealthMessage,
  HoursMessage,
  HornMessage,
  LiveMessage,
  LogMessage,
  MapsMessage,
  MissionMessage,
  Museum,
  OperationMessage,
  PathMessage,
  Point,
  Reason,
  ServerMessage,
  SoundMessage,
  SpeechMessage,
  VotesMessage,
  WindowMessage,
} from './protocol';
import { parsed } from './french';
import { decode } from './protocol';
import { type Asked, cancelOf, choiceOf, requestOf, voteOf, watchOf } from './orders';
import { keptAs, lineOf } from './site';
import { uuid7 } from './uuid';
import { pageLanguage, reasonText, word } from './words';

/** What this browser asked for, and has to see through. */
export interface Wish extends Asked {
  made: number;
  /** sending until the server has it on disk, then sent; from the board on, the board's word. */
  state: string;
  reason: Reason | null;
  seen: boolean;
}

export const store = {
  read<T>(key: string, otherwise: T): T {
    try {
      return JSON.parse(localStorage.getItem(keptAs(key)) ?? 'null') ?? otherwise;
    } catch {
      return otherwise;
    }
  },
  write(key: string, value: unknown): void {
    try {
      localStorage.setItem(keptAs(key), JSON.stringify(value));
    } catch {
      // private window: then it is forgotten with the page
    }
  },
};

/** What the reader wants: what they chose here once, else what their browser says. */
const wantedLanguage = () => store.read('language', '') || navigator.language.slice(0, 2);

/** The pose comes ten times a second: so long a silence [ms] is a dead line, which nobody else may ever report. */
const SILENCE = 3000;
/** A line that is not open after this time [ms] is tried anew. */
const CONNECTING = 5000;
/** What is not answered is said again after this time [ms]. */
const ANSWER = 3000;

const closedStates = ['fulfilled', 'failed', 'refused', 'cancelled'];
export const keyOf = (id: string) => id.slice(-8);

class App {
  museum = $state.raw<Museum | null>(null);
  connection = $state<'connecting' | 'open' | 'lost'>('connecting');
  mission = $state.raw<MissionMessage | null>(null);
  speech = $state.raw<SpeechMessage | null>(null);
  horn = $state.raw<HornMessage | null>(null);
  levels = $state.raw<SoundMessage | null>(null);
  expression = $state.raw<ExpressionMessage | null>(null);
  button = $state.raw<ButtonMessage | null>(null);
  board = $state.raw<BoardMessage | null>(null);
  health = $state.raw<HealthMessage | null>(null);
  hours = $state.raw<HoursMessage | null>(null);
  votes = $state.raw<VotesMessage | null>(null);
  /** For what this browser voted, and in which round. */
  private cast = $state(store.read('vote', { round: '', tour: '' }));
  path = $state.raw<PathMessage | null>(null);
  belief = $state.raw<BeliefMessage | null>(null);
  window = $state.raw<WindowMessage | null>(null);
  field = $state.raw<FieldMessage | null>(null);
  log = $state.raw<LogMessage | null>(null);
  /** For operators alone: what of `maps` lies over the map; how far the museum is mapped. */
  maps = $state.raw<MapsMessage | null>(null);
  shows = $state({ value: false, live: false });
  exploration = $state.raw<ExplorationMessage | null>(null);
  /** On the robot's own screen: there, it has a button that stops the robot. */
  operation = $state.raw<OperationMessage | null>(null);
  avoid = $state.raw<Avoid | null>(null);
  localized = $state(false);
  battery = $state<number | null>(null);
  speed = $state(0);
  turn = $state(0);

  language = $state(pageLanguage(wantedLanguage(), []));
  name = $state(store.read('name', ''));
  dark = $state(store.read<boolean | null>('dark', null) ?? matchMedia('(prefers-color-scheme: dark)').matches);
  calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
  sound = $state(false);
  expert = $state(false);
  selected = $state<string | null>(null);
  viewpoint = $state(-1);
  /** A point of the floor or a room that is chosen, not yet asked for; `at` [m]. */
  place = $state.raw<{ kind: 'point' | 'room'; target: string; at: Point } | null>(null);
  answered = $state('');
  toast = $state('');
  wishes = $state<Wish[]>(store.read<Wish[]>('wishes', []).filter((wish) => Date.now() - wish.made < 3 * 3600e3));
  /** Counts up with each wish that comes true: time to celebrate. */
  joys = $state(0);

  /** With which the robot's own screen comes; empty: a visitor's page. Set before `start`. */
  screenKey = '';
  readonly clock = new RobotClock();
  readonly motion = new Motion();
  /** A visitor who has asked once needs no hint. */
  hasAsked = $state(store.read('asked', false));
  private museumText = '';
  private socket: WebSocket | null = null;
  private tries = 0;
  private lastHeard = 0;
  private toastTimer = 0;
  /** Orders without an answer. They outlive a dead line: said again with the same id, they count once. */
  private unanswered = new Map<string, { order: ClientMessage; sent: number }>();

  async start(): Promise<void> {
    this.connect();
    setInterval(() => this.watchOver(), 500);
    for (let pause = 500; !(await this.readMuseum()); pause = Math.min(pause * 2, 8000))
      await new Promise((resolve) => setTimeout(resolve, pause));
  }
  /** Whether it was there. It stays the same object as long as it says the same. */
  private async readMuseum(): Promise<boolean> {
    const text = await fetchText('/api/museum.json');
    if (text === null || text === this.museumText) return text !== null;
    const isFirst = this.museum === null;
    this.museumText = text;
    this.museum = parsed(text) as Museum;
    if (isFirst) this.language = pageLanguage(wantedLanguage(), this.museum.languages);
    return true;
  }

  /** What its face shows; null while nobody says so. */
  get feeling(): ExpressionMessage | null {
    return this.connection === 'open' ? this.expression : null;
  }
  get isMoving(): boolean {
    return this.connection === 'open' && (Math.abs(this.speed) > 0.03 || Math.abs(this.turn) > 0.1);
  }
  t(key: Parameters<typeof word>[1]): string {
    return word(this.language, key);
  }
  /** A number as the reader's language writes it: 1.4, 1,4. */
  number(value: number, places: number): string {
    return value.toLocaleString(this.language, { minimumFractionDigits: places, maximumFractionDigits: places, useGrouping: false });
  }
  say(texts: Record<string, string> | undefined): string {
    if (!texts) return '';
    return texts[this.language] || texts[this.museum?.languages[0] ?? ''] || Object.values(texts)[0] || '';
  }
  exhibit(id: string): Exhibit | undefined {
    return this.museum?.exhibits.find((exhibit) => exhibit.id === id);
  }
  /** The hours of the Web's visitors: any place on the floor and any room may be wished for. */
  get isWebHours(): boolean {
    return this.connection === 'open' && this.hours?.mode === 'web' && this.hours.is_open;
  }
  votesFor(tour: string): number {
    return this.votes?.tours.find(([id]) => id === tour)?.[1] ?? 0;
  }
  /** The tour for which this browser voted in this round. */
  get myVote(): string {
    return this.cast.round === this.votes?.round ? this.cast.tour : '';
  }
  vote(tour: string): void {
    const voter = store.read('voter', '') || uuid7();
    store.write('voter', voter);
    this.cast = { round: this.votes?.round ?? '', tour };
    store.write('vote', this.cast);
    this.order(voteOf(uuid7(), voter, tour));
    this.notice(this.t(this.connection === 'open' ? 'voted' : 'kept'));
  }
  titleOf(kind: string, target: string): string {
    if (kind === 'point') return this.t('pointOnMap');
    const place = kind === 'room' ? this.museum?.rooms.find((room) => room.id === target)?.name : this.exhibit(target)?.title;
    return this.say(kind === 'tour' ? this.museum?.tours.find((tour) => tour.id === target)?.title : place) || target;
  }
  /** Why something is in this state; empty: nobody said so. */
  why(reason: Reason | null, state = ''): string {
    if (!reason) return '';
    const text = reasonText(this.language, reason, (id) => this.titleOf('exhibit', id));
    // What waits after something went wrong has its turn once more.
    return state === 'queued' && reason.word !== 'charging_first' ? `${text} ${this.t('tryAgain')}` : text;
  }
  setLanguage(language: string): void {
    this.language = language;
    store.write('language', language);
    declareLanguage(language);
  }
  setDark(dark: boolean): void {
    this.dark = dark;
    store.write('dark', dark);
  }
  setExpert(expert: boolean): void {
    this.expert = expert;
    this.send(watchOf(expert));
  }
  notice(text: string): void {
    this.toast = text;
    clearTimeout(this.toastTimer);
    this.toastTimer = window.setTimeout(() => (this.toast = ''), 4500);
  }

  // Wishes -------------------------------------------------------------------------------------------------------

  wishFor(kind: string, target: string): Wish | undefined {
    return this.wishes.find((w) => w.kind === kind && w.target === target && !closedStates.includes(w.state));
  }
  ask(kind: Wish['kind'], target: string, viewpoint = -1): void {
    if (this.wishFor(kind, target)) return;
    const wish: Wish = { id: uuid7(), kind, target, viewpoint, made: Date.now(), state: 'sending', reason: null, seen: false };
    this.wishes = [...this.wishes.slice(-30), wish];
    store.write('name', this.name);
    store.write('asked', (this.hasAsked = true));
    this.keepWishes();
    this.sendWish(wish);
    this.selected = null;
    this.place = null;
    if (this.connection !== 'open') this.notice(this.t('kept'));
  }
  cancel(wish: Wish): void {
    if (wish.state === 'sending' && !wish.seen) {
      this.wishes = this.wishes.filter((other) => other.id !== wish.id);
      this.keepWishes();
    }
    this.unanswered.delete(wish.id);
    this.order(cancelOf(uuid7(), wish.id));
  }
  answer(choice: string): void {
    const prompt = this.mission?.prompt;
    if (!prompt) return;
    this.answered = prompt.id;
    this.order(choiceOf(uuid7(), prompt.id, choice));
    if (this.connection !== 'open') this.notice(this.t('kept'));
  }
  /** Of the robot's own screen alone; `lamps` are told and not answered. */
  tell(message: Exclude<ClientMessage, { type: 'watch' | 'steer' }>): void {
    if (message.type === 'lamps') this.send(message);
    else this.order(message);
  }
  isMine(entry: BoardEntry): boolean {
    return this.wishes.some((wish) => keyOf(wish.id) === entry.key);
  }

  private keepWishes(): void {
    store.write('wishes', this.wishes);
  }
  private sendWish(wish: Wish): void {
    this.order(requestOf(wish, this.name, this.language));
  }
  private changeWish(id: string, change: Partial<Wish>): void {
    this.wishes = this.wishes.map((wish) => (wish.id === id ? { ...wish, ...change } : wish));
    this.keepWishes();
  }
  private followBoard(board: BoardMessage): void {
    const entries = new Map([...board.open, ...board.closed].map((entry) => [entry.key, entry]));
    let changed = false;
    const wishes = this.wishes.map((wish) => {
      const entry = entries.get(keyOf(wish.id));
      if (!entry || (entry.state === wish.state && wish.seen)) return wish;
      changed = true;
      this.unanswered.delete(wish.id);
      if (wish.state === 'sending' && !closedStates.includes(entry.state)) this.notice(this.t('onItsWay'));
      if (entry.state === 'fulfilled' && wish.state !== 'fulfilled') {
        ++this.joys;
        this.notice(`${this.t('hurray')} ${this.titleOf(wish.kind, wish.target)}`);
      }
      if (entry.state === 'refused' || entry.state === 'failed') {
        const why = this.why(entry.reason);
        this.notice(`${this.titleOf(wish.kind, wish.target)}: ${this.t(entry.state)}${why && ` (${why})`}`);
      }
      return { ...wish, state: entry.state, reason: entry.reason, seen: true };
    });
    if (changed) {
      this.wishes = wishes;
      this.keepWishes();
    }
  }

  // Connection ---------------------------------------------------------------------------------------------------

  private connect(): void {
    const socket = new WebSocket(lineOf(`/live${this.screenKey && `?screen=${this.screenKey}`}`));
    this.socket = socket;
    this.lastHeard = performance.now();
    socket.onopen = () => {
      this.lastHeard = performance.now();
      this.connection = 'open';
      if (this.expert) this.send(watchOf(true));
      if (this.museum) void this.readMuseum(); // it may be another one since
      // Whatever was not yet on the board is said again, with the same id: the server knows it if it had it.
      for (const wish of this.wishes) {
        if (!wish.seen && !closedStates.includes(wish.state)) this.sendWish(wish);
      }
      this.repeatOrders(1);
    };
    socket.onmessage = (event) => {
      this.lastHeard = performance.now();
      this.tries = 0;
      this.take(decode(event.data));
    };
    socket.onclose = () => this.drop();
  }
  /**
   * Gives the line up and calls again after a pause. Does not wait for the other end to agree: where the line is dead,
   * `close` reports its end after minutes only.
   */
  private drop(): void {
    const socket = this.socket;
    if (!socket) return;
    this.socket = null;
    socket.onopen = socket.onmessage = socket.onclose = null;
    socket.close();
    if (this.connection === 'open' && this.wishes.some((wish) => wish.state === 'sending')) this.notice(this.t('kept'));
    this.connection = 'lost';
    // Spread out, so that ten thousand pages do not come back in the same moment.
    const pause = Math.min(10000, 300 * 2 ** this.tries++) * (0.7 + 0.6 * Math.random());
    setTimeout(() => this.connect(), pause);
  }
  private watchOver(): void {
    const patience = this.connection === 'open' ? SILENCE : CONNECTING;
    if (this.socket && performance.now() - this.lastHeard > patience) this.drop();
    this.repeatOrders(ANSWER);
  }
  private order(order: Exclude<ClientMessage, { type: 'watch' | 'lamps' | 'steer' }>): void {
    this.unanswered.set(order.id, { order, sent: performance.now() });
    this.send(order);
  }
  /** Says again what had no answer for so long [ms]. */
  private repeatOrders(age: number): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    const now = performance.now();
    for (const entry of this.unanswered.values()) {
      if (now - entry.sent < age) continue;
      entry.sent = now;
      this.send(entry.order);
    }
  }
  private send(message: ClientMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
  private take(message: ServerMessage): void {
    switch (message.type) {
      case 'live':
        return this.takeLive(message);
      case 'pose':
        // A visitor among very many, or with a thin line: nothing but the robot moves.
        return this.takeLive({ ...message, type: 'live', hypotheses: [], scan: { frame: 'map', from: [0, 0], points: [] }, people: [] });
      case 'mission':
        if (message.prompt?.id !== this.mission?.prompt?.id) this.answered = '';
        this.mission = message;
        return;
      case 'board':
        this.board = message;
        return this.followBoard(message);
      case 'hours':
        this.hours = message;
        if (!this.isWebHours) this.place = null;
        return;
      case 'ack':
        this.unanswered.delete(message.id);
        if (this.wishes.some((wish) => wish.id === message.id && wish.state === 'sending')) {
          this.changeWish(message.id, { state: 'sent' });
          this.notice(this.t('onItsWay'));
        }
        return;
      case 'refused':
        this.unanswered.delete(message.id);
        this.changeWish(message.id, { state: 'refused', reason: message.reason });
        this.notice(`${this.t('refused')}: ${this.why(message.reason)}`);
        return;
      case 'error':
        return this.notice(this.why(message.reason));
      default:
        this.keep(message);
    }
  }
  /** What is shown as it came. */
  private keep(message: ServerMessage): void {
    switch (message.type) {
      case 'health':
        return void (this.health = message);
      case 'window':
        return void (this.window = message);
      case 'field':
        return void (this.field = message);
      case 'log':
        return void (this.log = message);
      case 'operation':
        return void (this.operation = message);
      case 'horn':
        return void (this.horn = message);
      case 'sound':
        return void (this.levels = message);
      case 'expression':
        return void (this.expression = message);
      case 'button':
        return void (this.button = message);
      case 'speech':
        return void (this.speech = message);
      case 'votes':
        return void (this.votes = message);
      case 'belief':
        return void (this.belief = message);
      case 'path':
        return void (this.path = message);
    }
  }
  private takeLive(message: LiveMessage): void {
    this.clock.see(message.t);
    this.motion.add(message);
    // Only what changes wakes the page up; the map draws from `motion` at the pace of the screen.
    const localized = message.pose !== null;
    if (localized !== this.localized) this.localized = localized;
    const battery = message.battery ?? null;
    if (battery !== this.battery) this.battery = battery;
    this.speed = Math.round(message.v * 100) / 100;
    this.turn = Math.round(message.w * 100) / 100;
    this.avoid = message.avoid ?? null;
  }
}

export const app = new App();
