// What the four figures show of a state.
const looks = [{ name: "first", width: 1.2, dashes: [5, 3] }, { name: "second", width: 1.3, dashes: [] }];

// Lightness rises from the smallest error to the largest, so that the map can be read in grey.
const scale = [[0, 34, 78], [65, 77, 107], [124, 123, 120], [188, 174, 108], [254, 232, 56]];

function shade(share) {
  const at = Math.min(1, Math.max(0, share)) * (scale.length - 1), low = Math.min(scale.length - 2, Math.floor(at));
  const mixed = scale[low].map((c, i) => Math.round(c + (at - low) * (scale[low + 1][i] - c)));
  return `rgb(${mixed.join(",")})`;
}

function drawTimes(panels, state, r, [from, to]) {
  const errors = r.errors.filter((_, i) => state.models[i]);
  const span = [state.from, state.to];
  panels.force.begin(span, extent(forces(state, r), from, to), "time / s", `force / ${unit}`);
  panels.error.begin(span, extent(errors, from, to), "time / s", `error / ${unit}`);
  for (const panel of [panels.force, panels.error]) {
    if (state.band) panel.box(state.band, panel.ySpan, "mark", 0.75);
    if (state.drag && state.drag.panel === panel) panel.box(state.drag.x, panel.ySpan, "accent", 0.18);
    if (state.region) strip(panel, r, state.region, from, to);
  }
  drawForces(panels.force, state, r, r.t, from, to);
  r.errors.forEach((error, i) => {
    if (state.models[i]) panels.error.line(r.t, error, from, to, looks[i % 2].name, 1.1);
  });
}

function forces(state, r) {
  return [...(state.measured ? [r.measured] : []), ...r.forces.filter((_, i) => state.models[i])];
}

function drawForces(panel, state, r, xs, from, to) {
  if (state.measured) panel.line(xs, r.measured, from, to, "measured", 2.4);
  r.forces.forEach((force, i) => {
    const { name, width, dashes } = looks[i % 2];
    if (state.models[i]) panel.line(xs, force, from, to, name, width, dashes);
  });
}

// Samples in the marked region of the map, as a strip along the time axis.
function strip(panel, r, region, from, to) {
  panel.inside((pen) => {
    pen.fillStyle = colour("accent");
    for (let i = from; i < to; i++) {
      if (within(r, i, region)) pen.fillRect(Math.round(panel.px(r.t[i])) - 1, Math.round(panel.bottom) - 6, 2, 6);
    }
  });
}

function within(r, i, region) {
  return r.x[i] >= region.x[0] && r.x[i] <= region.x[1] && r.v[i] >= region.v[0] && r.v[i] <= region.v[1];
}

function drawLoop(panel, state, r, [from, to]) {
  panel.begin(extent([r.x], from, to), extent(forces(state, r), from, to), "displacement / mm", `force / ${unit}`);
  drawForces(panel, state, r, r.x, from, to);
  if (state.region) panel.inside((pen) => {
    pen.fillStyle = colour("accent");
    for (let i = from; i < to; i++) {
      if (within(r, i, state.region)) pen.fillRect(panel.px(r.x[i]) - 1.5, panel.py(r.measured[i]) - 1.5, 3, 3);
    }
  });
}

function drawMap(panel, state, r, [from, to]) {
  const { cells, x, v, means } = r.map, values = means[state.mapped];
  const largest = values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0) || 1;
  panel.margin.right = 70;
  panel.begin(x, v, "displacement / mm", "velocity / mm/s");
  const dx = (x[1] - x[0]) / cells, dv = (v[1] - v[0]) / cells;
  panel.inside((pen) => {
    for (let i = 0; i < cells; i++) for (let j = 0; j < cells; j++) {
      const value = values[i * cells + j];
      if (Number.isNaN(value)) continue;
      pen.fillStyle = shade(0.5 + value / largest / 2);
      const left = panel.px(x[0] + i * dx), top = panel.py(v[0] + (j + 1) * dv);
      pen.fillRect(left, top, panel.px(x[0] + (i + 1) * dx) - left + 0.6, panel.py(v[0] + j * dv) - top + 0.6);
    }
  });
  if (to - from < r.t.length) panel.line(r.x, r.v, from, to, "ink", 0.7);
  const region = state.drag && state.drag.panel === panel ? state.drag : state.region;
  if (region) panel.inside((pen) => {
    const [px, py] = [panel.px(region.x[0]), panel.py(region.v[1])];
    pen.strokeStyle = colour("ink");
    pen.lineWidth = 2;
    pen.setLineDash([4, 3]);
    pen.strokeRect(px, py, panel.px(region.x[1]) - px, panel.py(region.v[0]) - py);
  });
  drawKey(panel, largest);
}

function drawKey(panel, largest) {
  const { pen } = panel, left = panel.right + 10, height = panel.bottom - panel.top;
  for (let i = 0; i < height; i++) {
    pen.fillStyle = shade(1 - i / height);
    pen.fillRect(left, panel.top + i, 9, 1.5);
  }
  pen.fillStyle = colour("soft");
  pen.textAlign = "left";
  for (const [at, text, base] of [[0, short(largest), "top"], [0.5, "0", "middle"], [1, short(-largest), "bottom"]]) {
    pen.textBaseline = base;
    pen.fillText(text, left + 13, panel.top + at * height);
  }
  pen.textBaseline = "top";
  pen.fillText(unit, left, panel.bottom + 5);
}

function drawCursor(panels, state, r) {
  const i = state.cursor;
  if (i === null) return;
  for (const panel of [panels.force, panels.error]) {
    panel.inside((pen) => {
      pen.strokeStyle = colour("soft");
      pen.lineWidth = 1;
      panel.stroke([[panel.px(r.t[i]), panel.top], [panel.px(r.t[i]), panel.bottom]]);
    });
  }
  panels.force.dot(r.t[i], r.measured[i], "ink");
  r.errors.forEach((error, m) => { if (state.models[m]) panels.error.dot(r.t[i], error[i], looks[m % 2].name); });
  panels.loop.dot(r.x[i], r.measured[i], "ink");
  panels.map.dot(r.x[i], r.v[i], "ink");
}
