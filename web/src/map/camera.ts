import type { Point } from '../lib/protocol';

/** Maps metres (y up) to pixels of the page (y down). */
export class Camera {
  /** Centre of the view [m]. */
  x = 0;
  y = 0;
  /** Pixels a metre. */
  scale = 20;
  width = 1;
  height = 1;
  /** Covered by panels [px]: the view is centred in what is left. */
  pad = { left: 0, right: 0, top: 0, bottom: 0 };

  get middleX(): number {
    return (this.pad.left + this.width - this.pad.right) / 2;
  }
  get middleY(): number {
    return (this.pad.top + this.height - this.pad.bottom) / 2;
  }
  px(x: number): number {
    return this.middleX + (x - this.x) * this.scale;
  }
  py(y: number): number {
    return this.middleY - (y - this.y) * this.scale;
  }
  toMap(px: number, py: number): Point {
    return [this.x + (px - this.middleX) / this.scale, this.y - (py - this.middleY) / this.scale];
  }
  /** The view in which the box fills the free part of the page. */
  fitted(low: Point, high: Point): { x: number; y: number; scale: number } {
    const wide = Math.max(50, this.width - this.pad.left - this.pad.right);
    const tall = Math.max(50, this.height - this.pad.top - this.pad.bottom);
    const scale = Math.min(wide / (high[0] - low[0]), tall / (high[1] - low[1]));
    return { x: (low[0] + high[0]) / 2, y: (low[1] + high[1]) / 2, scale };
  }
  zoom(factor: number, px: number, py: number, least: number): void {
    const [x, y] = this.toMap(px, py);
    this.scale = Math.min(160, Math.max(least, this.scale * factor));
    const [nx, ny] = this.toMap(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }
}
