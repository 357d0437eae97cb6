// The plots of one scene and lighting: `cases` are its results.

// What can be read as quality. `get`: of a case; less is better unless `more`.
const kMeasures = [
  { name: "foveated FLIP", get: (c) => c.scores.foveated_flip.mean },
  { name: "FLIP", get: (c) => c.scores.flip.mean },
  { name: "FLIP, weighted median", get: (c) => c.scores.flip.weighted_median },
  { name: "flicker energy", get: (c) => c.scores.flicker_energy },
  { name: "instability", get: (c) => c.scores.instability },
  { name: "PSNR (dB)", get: (c) => c.scores.psnr, more: true },
  { name: "SSIM", get: (c) => c.scores.ssim, more: true },
];

// The cases that no other one beats in time and in quality at once, by time.
function pareto(cases, measure) {
  const better = (a, b) => measure.more ? a > b : a < b;
  const known = cases.filter((c) => is_number(measure.get(c)));
  const beaten = (c) => known.some((other) => other !== c &&
    other.time_ms.median <= c.time_ms.median && !better(measure.get(c), measure.get(other)) &&
    (other.time_ms.median < c.time_ms.median || better(measure.get(other), measure.get(c))));
  return known.filter((c) => !beaten(c)).sort((a, b) => a.time_ms.median - b.time_ms.median);
}

function time_axis(cases) {
  const times = cases.map((c) => c.time_ms.median);
  const least = Math.min(...times), greatest = Math.max(...times);
  const clocks = distinct(cases.map((c) => c.clock)).join(" and ");
  const title = `ms a frame (median, ${clocks} clock)`;
  if (greatest < 8 * least || least <= 0) return from_zero(times, title);
  return { from: least / 1.3, to: greatest * 1.3, logarithmic: true, title };
}

// Where a label disturbs no mark and no other label, of four places around its mark.
function label_place(taken, x, y, text, plot) {
  const width = 6.6 * text.length, places = [
    [x + 11, y + 4, "start"], [x, y - 12, "middle"], [x, y + 21, "middle"], [x - 11, y + 4, "end"],
  ];
  const box = ([u, v, anchor]) => {
    const left = anchor === "start" ? u : anchor === "end" ? u - width : u - width / 2;
    return [left, v - 11, left + width, v + 3];
  };
  const cost = (place) => {
    const [l, t, r, b] = box(place);
    const outside =
      Math.max(0, r - plot.right) + Math.max(0, 60 - l) + Math.max(0, b - plot.bottom);
    return outside * 20 + taken.reduce((sum, [l2, t2, r2, b2]) => sum +
      Math.max(0, Math.min(r, r2) - Math.max(l, l2)) *
      Math.max(0, Math.min(b, b2) - Math.max(t, t2)), 0);
  };
  const chosen = places.reduce((a, b) => cost(b) < cost(a) ? b : a);
  taken.push(box(chosen));
  return chosen;
}

function pareto_plot(cases, measure, width) {
  const known = cases.filter((c) => is_number(measure.get(c)));
  if (known.length === 0) return html("p", { class: "note" }, "No case has this score.");
  const values = known.map(measure.get);
  const up = from_zero(values, measure.name + (measure.more ? " (more is better)" : ""));
  if (measure.more) {
    const room = Math.max(Math.max(...values) - Math.min(...values), 1e-3);
    up.from = Math.min(...values) - .15 * room;
    up.to = Math.max(...values) + .15 * room;
  }
  const plot = axes(width, 320, time_axis(known), up, `${measure.name} against time`);
  const front = pareto(known, measure);
  const at = (c) => [plot.x(c.time_ms.median), plot.y(measure.get(c))];
  let path = "";
  front.map(at).forEach(([x, y], i) => { path += i === 0 ? `M${x} ${y}` : `H${x}V${y}`; });
  plot.root.append(svg("path", { class: "frontline", d: path }));
  const taken = known.map(at).map(([x, y]) => [x - 8, y - 8, x + 8, y + 8]);
  for (const c of known) {
    const [x, y] = at(c), [u, v, anchor] = label_place(taken, x, y, c.case, plot);
    plot.root.append(svg("g", {},
      svg("title", {}, `${c.case}: ${number(c.time_ms.median)} ms, ${number(measure.get(c))}`),
      mark(c.index, x, y, 6, !front.includes(c)),
      svg("text", { class: "halo", x: u, y: v, "text-anchor": anchor }, c.case)));
  }
  return plot.root;
}

const band_limits = (cases) => distinct(cases.flatMap((c) => c.bands.slice(0, -1)
  .map((b) => `${b.name} to ${number(b.to)}°`))).join(", ");

function eccentricity_plot(cases, width) {
  const known = cases.filter((c) => c.eccentricity.degrees.length > 0);
  if (known.length === 0) return html("p", { class: "note" }, "No gaze, no eccentricity.");
  const degrees = known.flatMap((c) => c.eccentricity.degrees);
  const across = { from: 0, to: Math.max(...degrees) * 1.02, title: "eccentricity (degrees)" };
  const up = from_zero(known.flatMap((c) => c.eccentricity.flip), "FLIP, mean");
  const plot = axes(width, 320, across, up, "Error against eccentricity");
  for (const band of known[0].bands.slice(1))
    if (band.from < across.to)
      plot.root.append(svg("line", { class: "frontline", x1: plot.x(band.from),
                                     x2: plot.x(band.from), y1: plot.top, y2: plot.bottom }));
  for (const c of known)
    plot.root.append(line(plot, c.eccentricity.degrees.map((d, i) =>
      [d, c.eccentricity.flip[i] === undefined ? null : c.eccentricity.flip[i]]), c.index));
  return plot.root;
}

// A series of `key` over the measured frames; stretches of the path are parted by gaps.
function series_plot(cases, key, title, width) {
  const known = cases.filter((c) => c.series[key].some(is_number));
  if (known.length === 0) return html("p", { class: "note" }, "No case has two frames in a row.");
  const most = Math.max(...known.map((c) => c.series[key].length));
  const plot = axes(width, 260, { from: 0, to: Math.max(1, most - 1), title: "measured frame" },
    from_zero(known.flatMap((c) => c.series[key]), title), title);
  for (const c of known) {
    const points = [];
    c.series[key].forEach((value, i) => {
      if (i > 0 && c.series.frame[i] !== c.series.frame[i - 1] + 1) points.push([i, null]);
      points.push([i, value]);
    });
    plot.root.append(line(plot, points, c.index));
  }
  return plot.root;
}

// The stages that take most time in any of the cases; the others are summed.
function main_stages(cases) {
  const greatest = new Map();
  for (const c of cases)
    for (const stage of c.stages)
      greatest.set(stage.stage, Math.max(greatest.get(stage.stage) || 0, stage.median));
  return [...greatest].sort((a, b) => b[1] - a[1]).slice(0, 9).map(([name]) => name);
}

function stage_rows(c, names) {
  const parts = names.map((name) =>
    c.stages.filter((s) => s.stage === name).reduce((sum, s) => sum + s.median, 0));
  const rest = c.stages.filter((s) => !names.includes(s.stage))
    .reduce((sum, s) => sum + s.median, 0);
  return [...parts, rest];
}

function stage_plot(cases, width) {
  const names = main_stages(cases), row = 40, top = 4;
  const rows = cases.map((c) => stage_rows(c, names));
  const totals = rows.map((parts) => parts.reduce((a, b) => a + b, 0));
  const most = Math.max(...totals);
  if (!(most > 0))
    return html("p", { class: "note" }, "This device's clock gives no times of stages.");
  const scale = (width - 64) / most;
  const root = svg("svg", { viewBox: `0 0 ${width} ${top + row * cases.length}`, width,
                            height: top + row * cases.length, role: "img",
                            "aria-label": "Time of the stages" });
  cases.forEach((c, i) => {
    let x = 0;
    root.append(svg("text", { x: 0, y: top + i * row + 11 }, c.case));
    rows[i].forEach((ms, k) => {
      if (ms <= 0) return;
      root.append(svg("rect", { x: x * scale, y: top + i * row + 16, width: ms * scale, height: 16,
                                fill: colour(k), stroke: "var(--raised)", "stroke-width": .5 },
        svg("title", {}, `${names[k] || "other stages"}: ${number(ms)} ms`)));
      x += ms;
    });
    root.append(svg("text", { class: "tick", x: totals[i] * scale + 5, y: top + i * row + 28 },
      `${number(totals[i])} ms`));
  });
  return root;
}
