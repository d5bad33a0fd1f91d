// Pointer and keys on the figures.
function dragged(panel, start, x, y) {
  const sorted = (a, b) => (a < b ? [a, b] : [b, a]);
  return { panel, x: sorted(panel.xAt(start.x), panel.xAt(x)), v: sorted(panel.yAt(start.y), panel.yAt(y)) };
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const far = event.shiftKey ? 25 : 1, r = current(), i = state.cursor;
  const actions = {
    ArrowLeft: () => step(-far), ArrowRight: () => step(far),
    "+": () => zoomBy(0.5), "=": () => zoomBy(0.5), "-": () => zoomBy(2), 0: reset, Escape: reset,
    "[": () => show(state.recording - 1), "]": () => show(state.recording + 1),
    Enter: () => {
      state.region = state.region || i === null ? null : cellOf(r.x[i], r.v[i]);
      refresh();
    },
  };
  if (!actions[event.key]) return;
  event.preventDefault();
  actions[event.key]();
}

function listen(panel) {
  const { canvas } = panel;
  let start = null;
  const end = () => {
    start = null;
    state.drag = null;
    refresh();
  };
  canvas.addEventListener("pointerdown", (event) => {
    start = { x: event.offsetX, y: event.offsetY };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (start && panel !== panels.loop) state.drag = dragged(panel, start, event.offsetX, event.offsetY);
    state.cursor = nearest(panel, event.offsetX, event.offsetY);
    refresh();
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!start) return;
    const { drag } = state, far = Math.hypot(event.offsetX - start.x, event.offsetY - start.y);
    if (panel === panels.map) {
      const cell = state.region ? null : cellOf(panel.xAt(start.x), panel.yAt(start.y));
      state.region = far > 8 && drag ? { x: drag.x, v: drag.v } : cell;
    } else if (far > 8 && drag) {
      zoom(...drag.x);
    }
    end();
  });
  canvas.addEventListener("pointercancel", end);
  canvas.addEventListener("pointerleave", () => {
    if (start) return;
    state.cursor = null;
    refresh();
  });
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("keydown", onKey);
}
Object.values(panels).forEach(listen);
