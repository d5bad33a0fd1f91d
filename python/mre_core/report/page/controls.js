// Everything around the figures: recordings, curves, places, copying, paper.
const by = (id) => document.getElementById(id);
const result = JSON.parse(by("result").textContent);

function element(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function addCurve(label, look, changed) {
  const box = element("input", { type: "checkbox", checked: true });
  box.addEventListener("change", () => {
    changed(box.checked);
    refresh();
  });
  by("curves").append(element("label", { className: "toggle" }, box, element("i", { className: look }), label));
}

// The map shows one model: the first that is drawn.
function chooseMap() {
  state.mapped = Math.max(0, state.models.indexOf(true));
  by("map-of").textContent = `, ${models[state.mapped]}`;
}

carried.recordings.forEach((r, i) => by("recording").append(element("option", { value: String(i) }, r.name)));
addCurve("measured", "measured", (on) => { state.measured = on; });
models.forEach((name, i) => addCurve(name, `model${i}`, (on) => {
  state.models[i] = on;
  chooseMap();
}));
chooseMap();
by("recording").addEventListener("change", (event) => show(Number(event.target.value)));
const buttons = {
  previous: () => show(state.recording - 1), next: () => show(state.recording + 1),
  in: () => zoomBy(0.5), out: () => zoomBy(2), reset,
};
for (const [id, action] of Object.entries(buttons)) by(id).addEventListener("click", action);

// The recording that has the most samples in a region: the one shown, where it has any at all.
function mostWithin(region) {
  const counts = carried.recordings.map((_, place) => {
    const r = recordingAt(place);
    return r.t.reduce((count, _, i) => count + within(r, i, region), 0);
  });
  return counts[state.recording] > 0 ? state.recording : counts.indexOf(Math.max(...counts));
}

// A place of the mismatch, shown in all figures.
function showPlace(place) {
  const region = Array.isArray(place.x_mm) && Array.isArray(place.v_mm_s) ? { x: place.x_mm, v: place.v_mm_s } : null;
  const named = carried.recordings.findIndex((r) => r.name === place.recording);
  show(named >= 0 ? named : region ? mostWithin(region) : state.recording);
  if (Number.isFinite(place.from) && Number.isFinite(place.to)) {
    const margin = Math.max(place.to - place.from, 0.01 * (state.to - state.from));
    state.band = [place.from, place.to];
    zoom(place.from - margin, place.to + margin);
  } else if (place.drive_hz > 0) {
    const middle = (state.from + state.to) / 2;
    zoom(middle - 2 / place.drive_hz, middle + 2 / place.drive_hz);
  }
  state.region = region;
  by("viewer").scrollIntoView({ block: "start" });
  panels.force.canvas.focus({ preventScroll: true });
}
for (const button of document.querySelectorAll("[data-place]")) {
  button.addEventListener("click", () => showPlace(carried.where[Number(button.dataset.place)]));
}

function samples() {
  const r = current(), head = ["time_s", "displacement_mm", "velocity_mm_s", `force_${unit}`];
  const rows = [[...head, ...models.map((name) => `${name.replaceAll(" ", "_")}_${unit}`)].join(",")];
  r.t.forEach((t, i) => rows.push([t, r.x[i], r.v[i], r.measured[i], ...r.forces.map((f) => f[i])].join(",")));
  return `${rows.join("\n")}\n`;
}
const copies = {
  result: () => JSON.stringify(result, null, 2), samples, settings: () => by("settings").textContent,
};

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Where the clipboard is not open to a page from disk, a selection is.
    const area = element("textarea", { value: text, className: "hidden" });
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}
for (const button of document.querySelectorAll("[data-copy]")) {
  button.addEventListener("click", async () => {
    const text = copies[button.dataset.copy]();
    const done = await copy(text);
    by("copied").textContent = done ? `Copied ${text.length} characters.` : "This browser does not let a page copy.";
  });
}
by("whole").textContent = JSON.stringify(result, null, 1);

const names = { force: "Force", error: "Error of the force", loop: "Force over displacement", map: "Mean error over displacement and velocity" };
for (const [id, name] of Object.entries(names)) by(id).setAttribute("aria-label", `${name}: the arrow keys read values`);
new ResizeObserver(refresh).observe(by("viewer"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
matchMedia("print").addEventListener("change", draw);
window.addEventListener("beforeprint", () => { resolution = () => 3; draw(); });
window.addEventListener("afterprint", () => { resolution = () => window.devicePixelRatio || 1; draw(); });
show(0);
