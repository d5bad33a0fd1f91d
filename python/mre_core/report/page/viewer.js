// The state of the viewer, and what can be done with it.
const panels = Object.fromEntries(["force", "error", "loop", "map"].map((id) => [id, new Panel(id)]));
const state = {
  recording: 0, from: 0, to: 1, cursor: null, measured: true, models: models.map(() => true), mapped: 0,
  band: null, region: null, drag: null,
};
let waiting = false;

const current = () => recordingAt(state.recording);

// Samples within the time shown, and one beyond each end.
function visible(r) {
  return [Math.max(0, indexOf(r.t, state.from) - 1), Math.min(r.t.length, indexOf(r.t, state.to) + 1)];
}

function draw() {
  waiting = false;
  const r = current(), range = visible(r);
  drawTimes(panels, state, r, range);
  drawLoop(panels.loop, state, r, range);
  drawMap(panels.map, state, r, range);
  drawCursor(panels, state, r);
  document.getElementById("readout").textContent = described(r);
}

function refresh() {
  if (!waiting) requestAnimationFrame(draw);
  waiting = true;
}

function described(r) {
  const i = state.cursor;
  if (i === null) {
    return `${r.name}: rms error ${models.map((name, m) => `${name} ${short(r.rms[m])} ${unit}`).join(", ")}`;
  }
  const parts = [`${short(r.t[i])} s`, `x ${short(r.x[i])} mm`, `v ${short(r.v[i])} mm/s`, `measured ${short(r.measured[i])} ${unit}`];
  models.forEach((name, m) => parts.push(`${name} ${short(r.forces[m][i])} ${unit} (error ${short(r.errors[m][i])})`));
  return parts.join(" · ");
}

function show(place) {
  const count = carried.recordings.length;
  state.recording = (place + count) % count;
  state.cursor = null;
  const r = current();
  document.getElementById("recording").value = String(state.recording);
  document.getElementById("thinned").textContent = r.shown < r.samples
    ? `Drawn are ${r.shown} of ${r.samples} samples: of every stretch those with the extremes of force, displacement and error. The map is of all samples.`
    : "";
  reset();
}

function reset() {
  const { t } = current();
  Object.assign(state, { band: null, region: null, drag: null, from: t[0], to: t[t.length - 1] });
  refresh();
}

function zoom(from, to) {
  const { t } = current(), least = 4 * (t[t.length - 1] - t[0]) / t.length;
  if (to - from < least) [from, to] = [(from + to - least) / 2, (from + to + least) / 2];
  state.from = Math.max(t[0], from);
  state.to = Math.min(t[t.length - 1], to);
  refresh();
}

function zoomBy(factor) {
  const { t } = current();
  const about = state.cursor === null ? (state.from + state.to) / 2 : t[state.cursor];
  const half = (state.to - state.from) * factor / 2;
  zoom(about - half, about + half);
}

function step(by) {
  const { t } = current(), [from] = visible(current());
  state.cursor = Math.min(t.length - 1, Math.max(0, state.cursor === null ? from : state.cursor + by));
  const width = state.to - state.from, at = t[state.cursor];
  if (at < state.from) zoom(at, at + width);
  if (at > state.to) zoom(at - width, at);
  refresh();
}

// The cell of the map that holds a state.
function cellOf(x, v) {
  const { map } = current();
  return Object.fromEntries([["x", x], ["v", v]].map(([name, at]) => {
    const [low, high] = map[name], size = (high - low) / map.cells;
    const cell = Math.min(map.cells - 1, Math.max(0, Math.floor((at - low) / size)));
    return [name, [low + cell * size, low + (cell + 1) * size]];
  }));
}

function nearest(panel, px, py) {
  const r = current(), [from, to] = visible(r);
  if (panel === panels.force || panel === panels.error) {
    const at = panel.xAt(px), i = Math.min(to - 1, Math.max(from, indexOf(r.t, at)));
    return i > from && at - r.t[i - 1] < r.t[i] - at ? i - 1 : i;
  }
  const ys = panel === panels.loop ? r.measured : r.v;
  let found = from, least = Infinity;
  for (let i = from; i < to; i++) {
    const far = (panel.px(r.x[i]) - px) ** 2 + (panel.py(ys[i]) - py) ** 2;
    if (far < least) [found, least] = [i, far];
  }
  return found;
}
