// What the server sends and takes. contract.ts is written from the server's own definition, see
// src/docent/telepresence/contract.
import type { ServerMessage } from '../contract/contract';
import { parsed } from './french';

export type * from '../contract/contract';
export type Translations = Record<string, string>;
/** x, y [m], heading [rad] in the map's frame. */
export type Pose = [number, number, number];
export type Point = [number, number];

/** A text of the live channel. The contract's test says that the server sends nothing else. */
export const decode = (text: string): ServerMessage => parsed(text) as ServerMessage;
