// Elements, numbers and the plots. Text from the results only ever becomes text nodes.

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false) element.setAttribute(name, value);
  }
  element.append(...children.flat().filter((child) => child !== null));
  return element;
}
const html = (tag, attributes, ...children) =>
  fill(document.createElement(tag), attributes, children);
const svg = (tag, attributes, ...children) =>
  fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);

// Three significant digits, without exponents for what people read every day.
function number(value) {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(2);
  return String(size >= 100 ? +value.toFixed(size >= 1000 ? 0 : 1) : +value.toPrecision(3));
}

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length / 2;
  return (sorted[Math.floor(middle)] + sorted[Math.ceil(middle) - 1]) / 2;
};
const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const distinct = (values) => [...new Set(values)];
const is_number = (value) => typeof value === "number";

const colour = (index) => `var(--c${index % 10})`;

// A mark that can be told from its neighbours without its colour.
function mark(index, x, y, size, hollow) {
  const c = colour(index);
  const look = { fill: hollow ? "var(--ground)" : c, stroke: c, "stroke-width": 2 };
  const points = (list) => list.map(([u, v]) => `${x + u * size},${y + v * size}`).join(" ");
  switch (index % 5) {
    case 0: return svg("circle", { cx: x, cy: y, r: size, ...look });
    case 1: return svg("rect", { x: x - size * .9, y: y - size * .9, width: size * 1.8,
                                 height: size * 1.8, ...look });
    case 2: return svg("polygon", { points: points([[0, -1.2], [1.1, .8], [-1.1, .8]]), ...look });
    case 3: return svg("polygon", { points: points([[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]]),
                                    ...look });
    default: return svg("polygon", { points: points([[0, 1.2], [1.1, -.8], [-1.1, -.8]]),
                                     ...look });
  }
}

function legend(entries) {
  return html("ul", { class: "legend" }, entries.map(([index, text, kind]) => html("li", {},
    svg("svg", { width: 18, height: 14, viewBox: "0 0 18 14", "aria-hidden": "true" },
      kind === "bar" ? svg("rect", { x: 2, y: 1, width: 14, height: 12, fill: colour(index) })
        : mark(index, 9, 7, 5, kind === "hollow")),
    text)));
}

// Ticks at 1, 2 or 5 times a power of ten; of a logarithmic axis within each decade.
function ticks(from, to, logarithmic) {
  const result = [];
  if (logarithmic) {
    for (let decade = Math.floor(Math.log10(from)); decade <= Math.log10(to); ++decade)
      for (const step of [1, 2, 5]) result.push(step * 10 ** decade);
    return result.filter((value) => value >= from && value <= to);
  }
  const rough = (to - from) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((value) => value >= rough);
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to * (1 + 1e-9); ++i)
    result.push(+(i * step).toPrecision(12));
  return result;
}

// Axes over a drawing of `width` CSS pixels: { root, x, y } with x and y from data to drawing.
function axes(width, height, across, up, title) {
  const left = 66, right = 14, top = 12, bottom = 42;
  const place = (axis, from, to) => (value) => {
    const part = axis.logarithmic
      ? Math.log(value / axis.from) / Math.log(axis.to / axis.from)
      : (value - axis.from) / (axis.to - axis.from);
    return from + part * (to - from);
  };
  const x = place(across, left, width - right), y = place(up, height - bottom, top);
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img",
                            "aria-label": title });
  for (const value of ticks(across.from, across.to, across.logarithmic))
    root.append(svg("line", { class: "grid", x1: x(value), x2: x(value), y1: top,
                              y2: height - bottom }),
      svg("text", { class: "tick", x: x(value), y: height - bottom + 16,
                    "text-anchor": "middle" }, number(value)));
  for (const value of ticks(up.from, up.to, up.logarithmic))
    root.append(svg("line", { class: "grid", x1: left, x2: width - right, y1: y(value),
                              y2: y(value) }),
      svg("text", { class: "tick", x: left - 6, y: y(value) + 4, "text-anchor": "end" },
        number(value)));
  root.append(
    svg("text", { class: "axis", x: (left + width - right) / 2, y: height - 6,
                  "text-anchor": "middle" }, across.title),
    svg("text", { class: "axis", transform: `translate(12 ${(top + height - bottom) / 2})
                  rotate(-90)`, "text-anchor": "middle" }, up.title));
  return { root, x, y, top, bottom: height - bottom, right: width - right };
}

// The range of an axis with 0 in it; never empty.
function from_zero(values, title) {
  const known = values.filter(is_number);
  const least = Math.min(0, ...known), greatest = Math.max(0, ...known);
  const room = .08 * (greatest - least);
  if (room === 0) return { from: 0, to: 1, title };
  return { from: least < 0 ? least - room : 0, to: greatest + room, title };
}

// [x, y or null] as a path with gaps, and what stands between two gaps alone as a dot.
function line(plot, points, index) {
  let path = "", pen = false;
  const group = svg("g", {});
  points.forEach(([x, y], i) => {
    if (y === null) { pen = false; return; }
    path += `${pen ? "L" : "M"}${plot.x(x).toFixed(1)} ${plot.y(y).toFixed(1)}`;
    if (!pen && (i + 1 === points.length || points[i + 1][1] === null))
      group.append(svg("circle", { cx: plot.x(x), cy: plot.y(y), r: 2.5, fill: colour(index) }));
    pen = true;
  });
  const dashes = ["", "7 3", "2 3", "9 3 2 3", "12 4"][index % 5];
  group.append(svg("path", { d: path, fill: "none", stroke: colour(index), "stroke-width": 2,
                             "stroke-dasharray": dashes, "stroke-linejoin": "round" }));
  return group;
}

// A figure whose drawing follows the width that it has.
function figure(title, draw, below) {
  const place = html("div", {});
  const element = html("figure", {}, html("h3", {}, title), place, below);
  let drawn = 0;
  const redraw = (force) => {
    const width = Math.round(Math.min(760, Math.max(280, place.clientWidth || 600)));
    if (width === drawn && force !== true) return;
    drawn = width;
    place.replaceChildren(draw(width));
  };
  new ResizeObserver(redraw).observe(place);
  element.redraw = () => redraw(true);
  redraw(true);
  return element;
}
