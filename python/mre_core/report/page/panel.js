// One figure: a canvas with axes, whose colours are those of the page.
let resolution = () => window.devicePixelRatio || 1;

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

class Panel {
  constructor(id) {
    this.canvas = document.getElementById(id);
    this.pen = this.canvas.getContext("2d");
    this.margin = { left: 58, right: 12, top: 10, bottom: 38 };
  }

  // Clear, and draw the axes for two spans.
  begin(xSpan, ySpan, xLabel, yLabel) {
    const { canvas, pen, margin } = this;
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = resolution();
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.font = '12px system-ui, "Segoe UI", sans-serif';
    Object.assign(this, {
      xSpan, ySpan, left: margin.left, right: width - margin.right, top: margin.top, bottom: height - margin.bottom,
    });
    pen.strokeStyle = colour("grid");
    pen.fillStyle = colour("soft");
    pen.lineWidth = 1;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    for (const tick of ticks(ySpan, Math.max(3, height / 45))) {
      this.stroke([[this.left, this.py(tick)], [this.right, this.py(tick)]]);
      pen.fillText(short(tick), this.left - 6, this.py(tick));
    }
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const tick of ticks(xSpan, Math.max(3, width / 75))) {
      this.stroke([[this.px(tick), this.top], [this.px(tick), this.bottom]]);
      pen.fillText(short(tick), this.px(tick), this.bottom + 5);
    }
    pen.fillText(xLabel, (this.left + this.right) / 2, height - 15);
    pen.save();
    pen.translate(11, (this.top + this.bottom) / 2);
    pen.rotate(-Math.PI / 2);
    pen.textBaseline = "middle";
    pen.fillText(yLabel, 0, 0);
    pen.restore();
  }

  px(x) { return this.left + (x - this.xSpan[0]) / (this.xSpan[1] - this.xSpan[0]) * (this.right - this.left); }
  py(y) { return this.bottom - (y - this.ySpan[0]) / (this.ySpan[1] - this.ySpan[0]) * (this.bottom - this.top); }
  xAt(px) { return this.xSpan[0] + (px - this.left) / (this.right - this.left) * (this.xSpan[1] - this.xSpan[0]); }
  yAt(py) { return this.ySpan[0] + (this.bottom - py) / (this.bottom - this.top) * (this.ySpan[1] - this.ySpan[0]); }

  stroke(points) {
    this.pen.beginPath();
    for (const [x, y] of points) this.pen.lineTo(x, y);
    this.pen.stroke();
  }

  // Everything that `draw` draws stays inside the axes.
  inside(draw) {
    const { pen } = this;
    pen.save();
    pen.beginPath();
    pen.rect(this.left, this.top, this.right - this.left, this.bottom - this.top);
    pen.clip();
    draw(pen);
    pen.restore();
  }

  line(xs, ys, from, to, name, width, dashes = []) {
    this.inside((pen) => {
      pen.strokeStyle = colour(name);
      pen.lineWidth = width;
      pen.setLineDash(dashes);
      pen.lineJoin = "round";
      pen.beginPath();
      for (let i = from; i < to; i++) pen.lineTo(this.px(xs[i]), this.py(ys[i]));
      pen.stroke();
    });
  }

  box(x, y, name, alpha = 1) {
    this.inside((pen) => {
      pen.globalAlpha = alpha;
      pen.fillStyle = colour(name);
      const [a, b] = [this.px(x[0]), this.px(x[1])], [c, d] = [this.py(y[1]), this.py(y[0])];
      pen.fillRect(a, c, Math.max(1, b - a), Math.max(1, d - c));
    });
  }

  dot(x, y, name) {
    this.inside((pen) => {
      pen.fillStyle = colour(name);
      pen.strokeStyle = colour("card");
      pen.lineWidth = 1.5;
      pen.beginPath();
      pen.arc(this.px(x), this.py(y), 4.5, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    });
  }
}

function ticks([low, high], most) {
  const rough = (high - low) / most, unit = 10 ** Math.floor(Math.log10(rough));
  const step = unit * ([1, 2, 5].find((m) => unit * m >= rough) || 10);
  const found = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) found.push(Number((k * step).toPrecision(12)));
  return found;
}
