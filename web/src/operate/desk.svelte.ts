// The operators' own connection: orders, and what becomes of them.
import { ApiError, logIn, logOut, whoAmI } from '../lib/api';
import { faultText, forumWords } from '../forum/words';
import { leaseOf, requestOf, setHoursOf, steerOf, stopOf } from '../lib/orders';
import type { ClientMessage, Me, OperationMessage, SetHoursMessage } from '../lib/protocol';
import { decode } from '../lib/protocol';
import { lineOf } from '../lib/site';
import { app } from '../lib/state.svelte';
import { uuid7 } from '../lib/uuid';

/** [ms] between two orders to the wheels. */
const STEERING = 100;
/** [ms] without a sign of life the line counts as dead. */
const SILENCE = 3000;

class OperateDesk {
  me = $state.raw<Me | null>(null);
  operation = $state.raw<OperationMessage | null>(null);
  isOpen = $state(false);
  /** This page holds the lease. */
  hasWheel = $state(false);
  pressed = $state(false);
  forward = $state(0);
  turn = $state(0);
  private socket: WebSocket | null = null;
  private lease = '';
  /** The last one for a room. */
  private wish = '';

  get isOperator(): boolean {
    return this.me?.rank === 'operator';
  }
  get isModerator(): boolean {
    return this.isOperator || this.me?.rank === 'moderator';
  }
  get isStopped(): boolean {
    return this.operation?.stopped ?? false;
  }

  async start(): Promise<void> {
    setInterval(() => this.steer(), STEERING);
    await this.attempt(async () => this.become(await whoAmI()));
  }
  async logIn(name: string, password: string): Promise<void> {
    await this.attempt(async () => this.become(await logIn(name, password)));
  }
  async logOut(): Promise<void> {
    this.release();
    await this.attempt(async () => this.become(await logOut()));
  }
  async attempt(work: () => Promise<void>): Promise<void> {
    try {
      await work();
    } catch (error) {
      app.notice(faultText(forumWords(app.language), error instanceof ApiError ? error.reason : 'offline'));
    }
  }
  private become(me: Me): void {
    this.me = me;
    if (this.isOperator) this.connect();
    else this.drop();
  }

  private connect(): void {
    if (this.socket || !this.isOperator) return;
    const socket = new WebSocket(lineOf('/operate'));
    this.socket = socket;
    socket.onopen = () => (this.isOpen = true);
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => {
      this.drop();
      setTimeout(() => this.connect(), 1000);
    };
    setTimeout(() => {
      if (this.socket === socket && !this.isOpen) socket.close();
    }, SILENCE);
  }
  private drop(): void {
    const socket = this.socket;
    this.socket = null;
    this.isOpen = false;
    this.hasWheel = this.pressed = false;
    app.maps = app.exploration = null;
    if (!socket) return;
    socket.onclose = null;
    socket.close();
  }
  private take(text: string): void {
    const message = decode(text);
    if (message.type === 'operation') {
      this.operation = message;
      if (message.holder !== this.me?.name) this.hasWheel = false;
    } else if (message.type === 'maps') {
      app.maps = message;
    } else if (message.type === 'exploration') {
      app.exploration = message;
    } else if (message.type === 'ack' && message.id === this.lease) {
      this.hasWheel = true;
    } else if (message.type === 'refused' && message.id === this.wish) {
      app.notice(app.why(message.reason));
    } else if (message.type === 'refused' || message.type === 'error') {
      this.hasWheel = this.pressed = false;
      app.notice(app.why(message.reason));
    }
  }
  private send(message: ClientMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  takeWheel(): void {
    this.lease = uuid7();
    this.send(leaseOf(this.lease, true));
  }
  release(): void {
    if (this.hasWheel) this.send(leaseOf(uuid7(), false));
    this.hasWheel = this.pressed = false;
  }
  /** The hand holds the knob, and pulls it so far: shares of -1 to 1. */
  hold(forward: number, turn: number): void {
    [this.pressed, this.forward, this.turn] = [true, forward, turn];
  }
  letGo(): void {
    if (!this.pressed) return;
    this.pressed = false;
    this.forward = this.turn = 0;
    this.steer();
  }
  /** Sent all the time while this page holds the wheel: silence means that nobody is there. */
  private steer(): void {
    if (!this.hasWheel) return;
    this.send(steerOf(this.pressed, this.forward, this.turn));
  }
  stop(stopped: boolean): void {
    this.send(stopOf(uuid7(), stopped, stopped ? 0 : (this.operation?.stop_number ?? 0)));
  }
  /** Sends it into a room, or into the next one. */
  goTo(room: string): void {
    this.wish = uuid7();
    this.send(requestOf({ id: this.wish, kind: 'room', target: room, viewpoint: -1 }, this.me?.name ?? '', app.language));
  }
  setHours(mode: SetHoursMessage['mode']): void {
    this.send(setHoursOf(uuid7(), mode));
  }
}

export const desk = new OperateDesk();
