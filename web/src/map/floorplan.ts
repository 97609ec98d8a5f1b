import type { Hazard, Museum, Point } from '../lib/protocol';
import { addressOf } from '../lib/site';
import type { Camera } from './camera';
import { contoursOf } from './contours';
import type { Palette } from './palette';

/** The building: walls, floor and hazards as outlines [m], drawn once for each view. */
export class Floorplan {
  private walls = new Path2D();
  readonly floor = new Path2D();
  low: Point = [0, 0];
  high: Point = [1, 1];

  constructor(private museum: Museum) {}

  async load(): Promise<void> {
    const { columns, rows, resolution, origin, url } = this.museum.map;
    const reply = await fetch(addressOf(url), { signal: AbortSignal.timeout(20000) });
    if (!reply.ok) throw new Error(`${url}: ${reply.status}`);
    const picture = await createImageBitmap(await reply.blob());
    const canvas = document.createElement('canvas');
    canvas.width = columns;
    canvas.height = rows;
    const context = canvas.getContext('2d', { willReadFrequently: true })!;
    context.drawImage(picture, 0, 0);
    const pixels = context.getImageData(0, 0, columns, rows).data;
    const grey = (x: number, y: number) => pixels[4 * (y * columns + x)];
    const add = (path: Path2D, loops: number[][]) => {
      for (const loop of loops) {
        for (let i = 0; i < loop.length; i += 2) {
          const x = origin[0] + loop[i] * resolution;
          const y = origin[1] + (rows - loop[i + 1]) * resolution;
          if (i === 0) path.moveTo(x, y);
          else path.lineTo(x, y);
        }
        path.closePath();
      }
    };
    add(this.walls, contoursOf(columns, rows, (x, y) => grey(x, y) < 64));
    // The floor reaches under the walls, so that no gap shows; what is neither is outside the building.
    const floorLoops = contoursOf(columns, rows, (x, y) => grey(x, y) > 192);
    add(this.floor, floorLoops);
    let [left, top, right, bottom] = [columns, rows, 0, 0];
    for (const loop of floorLoops) {
      if (loop.length < 8) continue;
      for (let i = 0; i < loop.length; i += 2) {
        left = Math.min(left, loop[i]);
        right = Math.max(right, loop[i]);
        top = Math.min(top, loop[i + 1]);
        bottom = Math.max(bottom, loop[i + 1]);
      }
    }
    if (left < right) {
      this.low = [origin[0] + left * resolution, origin[1] + (rows - bottom) * resolution];
      this.high = [origin[0] + right * resolution, origin[1] + (rows - top) * resolution];
    } else {
      this.low = origin;
      this.high = [origin[0] + columns * resolution, origin[1] + rows * resolution];
    }
  }

  draw(context: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
    context.save();
    context.translate(camera.px(0), camera.py(0));
    context.scale(camera.scale, -camera.scale);
    context.lineJoin = 'round';

    context.shadowColor = palette.houseShadow;
    context.shadowBlur = 28;
    context.shadowOffsetY = 10;
    context.fillStyle = palette.floor;
    context.fill(this.floor, 'evenodd');
    context.shadowColor = 'transparent';
    // Under the walls too.
    context.lineWidth = 0.3;
    context.strokeStyle = palette.floor;
    context.stroke(this.floor);

    context.save();
    context.clip(this.floor, 'evenodd');
    this.parquet(context, palette);
    this.keepOut(context, palette);
    for (const hazard of this.museum.hazards) this.hazard(context, hazard, palette);
    // Walls throw a soft shadow on the floor.
    context.shadowColor = palette.wallShadow;
    context.shadowBlur = 0.35 * camera.scale;
    context.shadowOffsetX = 0.06 * camera.scale;
    context.shadowOffsetY = 0.14 * camera.scale;
    context.fillStyle = palette.wall;
    context.fill(this.walls, 'evenodd');
    context.restore();

    context.fillStyle = palette.wall;
    context.strokeStyle = palette.wall;
    context.lineWidth = 0.04;
    context.fill(this.walls, 'evenodd');
    context.stroke(this.walls);
    this.homeMat(context, palette);
    this.doors(context, camera, palette);
    context.restore();
  }
  /** A dashed ring where one walks from one room into another. */
  private doors(context: CanvasRenderingContext2D, camera: Camera, palette: Palette): void {
    context.strokeStyle = palette.path;
    context.globalAlpha = 0.4;
    context.lineWidth = 1.5 / camera.scale;
    context.setLineDash([3 / camera.scale, 3 / camera.scale]);
    for (const door of this.museum.doors) {
      context.beginPath();
      context.arc(door.at[0], door.at[1], Math.max(0.25, door.width / 2), 0, 7);
      context.stroke();
    }
  }

  private parquet(context: CanvasRenderingContext2D, palette: Palette): void {
    const [x0, y0] = this.low;
    const [x1, y1] = this.high;
    context.lineWidth = 0.018;
    context.strokeStyle = palette.parquet;
    context.beginPath();
    const plank = 1.2;
    for (let row = Math.floor(y0 / 0.6); row * 0.6 < y1; ++row) {
      const y = row * 0.6;
      context.moveTo(x0, y);
      context.lineTo(x1, y);
      const shift = (row % 2) * (plank / 2);
      for (let x = Math.floor(x0 / plank) * plank + shift; x < x1; x += plank) {
        context.moveTo(x, y);
        context.lineTo(x, y + 0.6);
      }
    }
    context.stroke();
  }

  /** Where the robot never goes lies in a light shade. */
  private keepOut(context: CanvasRenderingContext2D, palette: Palette): void {
    const area = this.museum.area;
    if (area.length < 3) return;
    const outside = new Path2D();
    outside.rect(this.low[0] - 5, this.low[1] - 5, this.high[0] - this.low[0] + 10, this.high[1] - this.low[1] + 10);
    area.forEach(([x, y], i) => (i === 0 ? outside.moveTo(x, y) : outside.lineTo(x, y)));
    outside.closePath();
    context.fillStyle = palette.keepOut;
    context.fill(outside, 'evenodd');
  }

  private hazard(context: CanvasRenderingContext2D, hazard: Hazard, palette: Palette): void {
    const path = new Path2D();
    let [left, low, right, high] = [Infinity, Infinity, -Infinity, -Infinity];
    hazard.polygon.forEach(([x, y], i) => {
      if (i === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
      left = Math.min(left, x);
      right = Math.max(right, x);
      low = Math.min(low, y);
      high = Math.max(high, y);
    });
    path.closePath();
    const look = palette.hazards[hazard.kind];
    context.fillStyle = look.fill;
    context.fill(path);
    context.save();
    context.clip(path);
    context.strokeStyle = look.line;
    context.beginPath();
    if (hazard.kind === 'stairs') {
      // Treads across the longer side.
      context.lineWidth = 0.05;
      if (right - left > high - low) {
        for (let x = left + 0.3; x < right; x += 0.3) {
          context.moveTo(x, low);
          context.lineTo(x, high);
        }
      } else {
        for (let y = low + 0.3; y < high; y += 0.3) {
          context.moveTo(left, y);
          context.lineTo(right, y);
        }
      }
    } else if (hazard.kind === 'glass') {
      context.lineWidth = 0.09;
      const size = right - left + (high - low);
      for (let s = 0.35; s < size; s += 0.8) {
        context.moveTo(left + s - 0.25, low - 0.1);
        context.lineTo(left + s - 0.25 - (high - low) * 0.6, high + 0.1);
      }
    } else {
      context.lineWidth = 0.03;
      const step = hazard.kind === 'plate' ? 0.3 : 0.45;
      for (let s = -(high - low); s < right - left; s += step) {
        context.moveTo(left + s, low);
        context.lineTo(left + s + (high - low), high);
        if (hazard.kind !== 'plate') continue;
        context.moveTo(left + s, high);
        context.lineTo(left + s + (high - low), low);
      }
    }
    context.stroke();
    context.restore();
    context.lineWidth = 0.05;
    context.strokeStyle = look.edge;
    context.stroke(path);
  }

  private homeMat(context: CanvasRenderingContext2D, palette: Palette): void {
    const [x, y] = this.museum.home;
    context.lineWidth = 0.06;
    context.strokeStyle = palette.home;
    context.setLineDash([0.16, 0.12]);
    context.beginPath();
    context.arc(x, y, 0.55, 0, 7);
    context.stroke();
    context.setLineDash([]);
    const charger = this.museum.charger;
    if (!charger) return;
    context.save();
    context.translate(charger[0], charger[1]);
    context.fillStyle = palette.home;
    context.beginPath();
    context.moveTo(0.1, 0.35);
    context.lineTo(-0.2, -0.05);
    context.lineTo(-0.02, -0.05);
    context.lineTo(-0.1, -0.35);
    context.lineTo(0.2, 0.05);
    context.lineTo(0.02, 0.05);
    context.closePath();
    context.fill();
    context.restore();
  }
}
