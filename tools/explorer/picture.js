// Pictures as SVG: axes with units, lines with labels at their ends, zones, marks.
const SVG = "http://www.w3.org/2000/svg";

function element(name, attributes, text, parent) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined && text !== null) made.textContent = text;
  parent?.append(made);
  return made;
}

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"]];

// Unit for numbers up to `largest`: [factor, name].
function scaled(largest, unit) {
  const [factor, prefix] = PREFIXES.find(([f]) => largest >= f * 0.9999) ?? PREFIXES.at(-1);
  return [factor, prefix + unit];
}

function with_unit(value, unit, digits = 4) {
  if (!Number.isFinite(value)) return "never";
  if (value === 0) return `0 ${unit}`;
  const [factor, name] = scaled(Math.abs(value), unit);
  return `${Number((value / factor).toPrecision(digits))} ${name}`;
}

function nice_step(range, count) {
  const raw = range / count, power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((k) => k * power >= raw) ?? 10);
}

class Picture {
  // axes x and y: {low, high, log, label, unit}; numbers are SI, ticks in the unit that fits.
  constructor(svg, x, y, title) {
    this.svg = svg;
    this.x = x;
    this.y = y;
    this.width = Math.max(260, svg.parentElement.clientWidth - 2);
    this.height = Math.round(Math.min(340, Math.max(230, 0.62 * this.width)));
    this.left = 62, this.right = this.width - 14, this.top = 10, this.bottom = this.height - 42;
    svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    svg.setAttribute("width", this.width);
    svg.setAttribute("height", this.height);
    svg.replaceChildren();
    element("title", {}, title, svg);
    this.clip = `clip-${svg.id}`;
    const clip = element("clipPath", {id: this.clip}, null, element("defs", {}, null, svg));
    element("rect", {x: this.left, y: this.top, width: this.right - this.left, height: this.bottom - this.top}, null, clip);
    this.under = element("g", {"clip-path": `url(#${this.clip})`}, null, svg);
    this.grid = element("g", {}, null, svg);
    this.inside = element("g", {"clip-path": `url(#${this.clip})`}, null, svg);
    this.over = element("g", {}, null, svg);
    this.taken = [];
    this.axis(x, true);
    this.axis(y, false);
  }

  place(axis, value, from, to) {
    const share = axis.log ? Math.log(value / axis.low) / Math.log(axis.high / axis.low) : (value - axis.low) / (axis.high - axis.low);
    return from + share * (to - from);
  }
  at_x(value) { return this.place(this.x, value, this.left, this.right); }
  at_y(value) { return this.place(this.y, value, this.bottom, this.top); }
  x_of(pixel) {
    const share = (pixel - this.left) / (this.right - this.left), {low, high, log} = this.x;
    return log ? low * (high / low) ** share : low + share * (high - low);
  }

  axis(axis, across) {
    const [factor, unit] = axis.log || !axis.unit ? [1, axis.unit] : scaled(axis.high, axis.unit);
    const ticks = [];
    if (axis.log) {
      const every = Math.ceil(Math.log10(axis.high / axis.low) / 6);
      for (let p = Math.ceil(Math.log10(axis.low) - 1e-9); 10 ** p <= axis.high * 1.0001; p += every) ticks.push([10 ** p, `${Number((10 ** p).toPrecision(1))}`]);
    } else {
      const step = nice_step((axis.high - axis.low) / factor, across ? 6 : 5);
      for (let t = Math.ceil(axis.low / factor / step) * step; t <= axis.high / factor * 1.0001; t += step)
        ticks.push([t * factor, `${Number(t.toPrecision(6))}`]);
    }
    for (const [value, text] of ticks) {
      if (across) {
        const at = this.at_x(value);
        element("line", {x1: at, x2: at, y1: this.top, y2: this.bottom, class: "grid"}, null, this.grid);
        element("text", {x: at, y: this.bottom + 16, class: "tick", "text-anchor": "middle"}, text, this.grid);
      } else {
        const at = this.at_y(value);
        element("line", {x1: this.left, x2: this.right, y1: at, y2: at, class: "grid"}, null, this.grid);
        element("text", {x: this.left - 5, y: at + 4, class: "tick", "text-anchor": "end"}, text, this.grid);
      }
    }
    const label = unit ? `${axis.label}, ${unit}` : axis.label, middle = (this.top + this.bottom) / 2;
    if (across) element("text", {x: (this.left + this.right) / 2, y: this.height - 8, class: "label", "text-anchor": "middle"}, label, this.grid);
    else element("text", {x: 12, y: middle, class: "label", "text-anchor": "middle", transform: `rotate(-90 12 ${middle})`}, label, this.grid);
  }

  path(xs, ys) {
    let d = "", pen = "M";
    for (let k = 0; k < xs.length; ++k) {
      if (!Number.isFinite(xs[k]) || !Number.isFinite(ys[k]) || (this.x.log && !(xs[k] > 0)) || (this.y.log && !(ys[k] > 0))) { pen = "M"; continue; }
      d += `${pen}${this.at_x(xs[k]).toFixed(1)} ${this.at_y(ys[k]).toFixed(1)}`;
      pen = "L";
    }
    return d;
  }
  line(xs, ys, kind) { element("path", {d: this.path(xs, ys), class: `line ${kind}`}, null, this.inside); }
  area(xs, ys, kind) { element("path", {d: `${this.path(xs, ys)}Z`, class: `area ${kind}`}, null, this.under); }

  // Text beside a point, at its left if asked or where the picture ends, moved up or down where another label lies.
  label(x, y, text, kind, left_side = false) {
    const px = this.at_x(x), toLeft = left_side || px > this.right - 70;
    let py = Math.min(Math.max(this.at_y(y), this.top + 10), this.bottom - 6);
    const left = toLeft ? px - 70 : px, clash = () => this.taken.find(([l, at]) => Math.abs(l - left) < 80 && Math.abs(at - py) < 13);
    for (let tries = 0; tries < 12 && clash(); ++tries) py = clash()[1] + (clash()[1] + 14 > this.bottom - 4 ? -14 * (tries + 1) : 14);
    this.taken.push([left, py]);
    element("text", {x: toLeft ? px - 8 : px + 8, y: py + 4, class: `name ${kind}`, "text-anchor": toLeft ? "end" : "start"}, text, this.over);
  }
  zone(low, high, kind, text) {
    const from = Math.max(this.left, this.at_x(Math.max(low, this.x.low))), to = Math.min(this.right, this.at_x(Math.min(high, this.x.high)));
    if (!(to > from)) return;
    element("rect", {x: from, y: this.top, width: to - from, height: this.bottom - this.top, class: `zone ${kind}`}, null, this.under);
    if (to - from > 6.5 * text.length) element("text", {x: (from + to) / 2, y: this.bottom - 8, class: "zone-name", "text-anchor": "middle"}, text, this.over);
  }
  upright(x, text, kind = "") {
    if (!(x >= this.x.low && x <= this.x.high)) return;
    const at = this.at_x(x), toLeft = at > this.right - 80;
    element("line", {x1: at, x2: at, y1: this.top, y2: this.bottom, class: `mark ${kind}`}, null, this.inside);
    if (text) element("text", {x: at + (toLeft ? -5 : 5), y: this.top + 12, class: "mark-name", "text-anchor": toLeft ? "end" : "start"}, text, this.over);
  }
  level(y, text) {
    if (!(y >= this.y.low && y <= this.y.high)) return;
    const at = this.at_y(y);
    element("line", {x1: this.left, x2: this.right, y1: at, y2: at, class: "mark"}, null, this.inside);
    element("text", {x: this.left + 6, y: at - 4, class: "mark-name"}, text, this.over);
  }
  dot(x, y, kind) { return element("circle", {cx: this.at_x(x), cy: this.at_y(y), r: 6, class: `dot ${kind}`}, null, this.over); }
}
