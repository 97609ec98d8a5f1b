const MOST = 30; // frames a second: a robot that drives 0.7 m/s moves two centimetres from one to the next
const SHARE = 0.25; // of the time, at most, goes into drawing: a slow device draws less often

/** Calls `draw` again and again while the page is shown; returns how to end it. `now` [ms], as performance.now(). */
export function animate(draw: (now: number) => void): () => void {
  let next = 0;
  let request = 0;
  const step = (now: number): void => {
    request = requestAnimationFrame(step);
    if (now < next - 1) return; // frames of a screen are not evenly spaced
    const begin = performance.now();
    draw(now);
    next = Math.max(now + 1000 / MOST, now + (performance.now() - begin) / SHARE);
  };
  request = requestAnimationFrame(step);
  return () => cancelAnimationFrame(request);
}
