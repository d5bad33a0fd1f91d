// What the page carries: recordings, unpacked when they are first shown.
const carried = JSON.parse(document.getElementById("series").textContent);
const models = carried.models, unit = carried.unit;
const unpacked = new Map();

function numbers(text, Kind) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Kind(bytes.buffer);
}

function recordingAt(place) {
  if (!unpacked.has(place)) {
    const packed = carried.recordings[place];
    const measured = numbers(packed.measured, Float32Array);
    const forces = packed.forces.map((text) => numbers(text, Float32Array));
    unpacked.set(place, {
      name: packed.name, samples: packed.samples, shown: packed.shown, rms: packed.rms,
      t: numbers(packed.time, Float64Array),
      x: numbers(packed.displacement, Float32Array),
      v: numbers(packed.velocity, Float32Array),
      measured, forces,
      errors: forces.map((force) => measured.map((value, i) => value - force[i])),
      map: {
        cells: packed.map.cells, x: packed.map.x, v: packed.map.v,
        means: packed.map.means.map((text) => numbers(text, Float32Array)),
      },
    });
  }
  return unpacked.get(place);
}

// First index whose value is not below the wanted one, in rising values.
function indexOf(values, wanted) {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < wanted) low = middle + 1; else high = middle;
  }
  return low;
}

function extent(arrays, from, to) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays) for (let i = from; i < to; i++) {
    if (values[i] < low) low = values[i];
    if (values[i] > high) high = values[i];
  }
  if (!(low <= high)) return [-1, 1];
  const margin = 0.05 * (high - low) || Math.abs(high) / 10 || 1;
  return [low - margin, high + margin];
}

function short(value) {
  if (!Number.isFinite(value)) return "";
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toExponential(2) : String(Number(value.toPrecision(4)));
}
