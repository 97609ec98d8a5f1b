interface Flake {
  x: number;
  y: number;
  vx: number;
  vy: number;
  turn: number;
  spin: number;
  color: string;
  born: number;
}

/** A handful of paper when a wish has come true. */
export class Confetti {
  private flakes: Flake[] = [];
  private last = 0;

  burst(x: number, y: number): void {
    const colors = ['#ff6b4a', '#ffd166', '#1d9a8a', '#7c4dff', '#3d7dd8', '#e0699a'];
    const born = performance.now() / 1000;
    for (let i = 0; i < 90; ++i) {
      const angle = -Math.PI / 2 + (Math.random() - 0.5) * 2.2;
      const speed = 140 + Math.random() * 260;
      this.flakes.push({
        x, y,
        vx: Math.cos(angle) * speed,
        vy: Math.sin(angle) * speed,
        turn: Math.random() * 6,
        spin: (Math.random() - 0.5) * 12,
        color: colors[i % colors.length],
        born,
      });
    }
  }
  draw(context: CanvasRenderingContext2D, time: number): void {
    const step = Math.min(0.05, time - this.last);
    this.last = time;
    this.flakes = this.flakes.filter((flake) => time - flake.born < 3);
    for (const flake of this.flakes) {
      flake.vy += 420 * step;
      flake.vx *= 1 - 1.2 * step;
      flake.vy *= 1 - 1.2 * step;
      flake.x += flake.vx * step;
      flake.y += flake.vy * step;
      flake.turn += flake.spin * step;
      context.save();
      context.translate(flake.x, flake.y);
      context.rotate(flake.turn);
      context.globalAlpha = Math.min(1, 3 - (time - flake.born));
      context.fillStyle = flake.color;
      context.fillRect(-4, -2.5, 8, 5 * Math.abs(Math.cos(flake.turn * 1.7)) + 1);
      context.restore();
    }
  }
}
