// Tables of numbers.

// Bands as the results name them, in their order.
const band_names = (cases) => distinct(cases.flatMap((c) => c.bands.map((b) => b.name)));
const band = (c, name) => c.bands.find((b) => b.name === name);

// `columns`: { title, get, more (better), plain (neither) }; `first`: what names a row.
function table(rows, first, columns) {
  const best = columns.map((column) => {
    const values = rows.map(column.get).filter(is_number);
    if (column.plain || values.length < 2) return null;
    return column.more ? Math.max(...values) : Math.min(...values);
  });
  const cell = (row, column, i) => {
    const value = column.get(row);
    return html("td", { class: is_number(value) && value === best[i] ? "best" : null },
      is_number(value) ? number(value) : value === null || value === undefined ? "–" : value);
  };
  return html("div", { class: "table" }, html("table", {},
    html("thead", {}, html("tr", {}, html("th", { scope: "col" }, first.title),
      columns.map((column) => html("th", { scope: "col" }, column.title)))),
    html("tbody", {}, rows.map((row) => html("tr", {},
      html("td", {}, first.get(row)), columns.map((column, i) => cell(row, column, i)))))));
}

const case_cell = (front) => ({
  title: "case",
  get: (c) => html("span", {}, front.includes(c)
    ? html("span", { class: "front", title: "on the Pareto front" }, "★ ") : null, c.case),
});

function time_table(cases, front) {
  const full = cases.find((c) => c.method === "full");
  return table(cases, case_cell(front), [
    { title: "ms median", get: (c) => c.time_ms.median },
    { title: "p95", get: (c) => c.time_ms.p95 },
    { title: "p99", get: (c) => c.time_ms.p99 },
    { title: "speed-up", more: true,
      get: (c) => full ? full.time_ms.median / c.time_ms.median : null },
    { title: "wall ms", get: (c) => c.wall_ms.median },
    { title: "samples a pixel", get: (c) => c.samples / (c.width * c.height), plain: true },
    { title: "scale", get: (c) => c.parameters.scale, plain: true },
    { title: "million rays", get: (c) => c.rays / 1e6, plain: true },
  ]);
}

function score_table(cases, front) {
  const scores = [
    { title: "foveated FLIP", get: (c) => c.scores.foveated_flip.mean },
    { title: "FLIP", get: (c) => c.scores.flip.mean },
    { title: "q1", get: (c) => c.scores.flip.q1 },
    { title: "median", get: (c) => c.scores.flip.weighted_median },
    { title: "q3", get: (c) => c.scores.flip.q3 },
    { title: "max", get: (c) => c.scores.flip.max },
    { title: "PSNR", more: true,
      get: (c) => c.scores.psnr === null ? "identical" : c.scores.psnr },
    { title: "SSIM", more: true, get: (c) => c.scores.ssim },
    { title: "flicker energy", get: (c) => c.scores.flicker_energy },
    { title: "instability", get: (c) => c.scores.instability },
  ];
  return table(cases, case_cell(front), scores);
}

function band_table(cases, front) {
  const columns = band_names(cases).flatMap((name) => [
    { title: `${name}: FLIP`, get: (c) => band(c, name) ? band(c, name).flip : null },
    { title: "flicker energy",
      get: (c) => band(c, name) ? band(c, name).flicker_energy : null },
    { title: "instability",
      get: (c) => band(c, name) ? band(c, name).instability : null },
  ]);
  columns.push({ title: "inside r0, against full: FLIP",
                 get: (c) => c.against_full.flip_inside_r0 });
  return table(cases, case_cell(front), columns);
}

// A method beside the `lowres` that took as many samples, or as long.
function equal_table(groups) {
  const rows = [];
  for (const group of groups)
    for (const low of group.cases.filter((c) => c.parameters.equal)) {
      const ours = group.cases.find((c) => c.case === low.parameters.equal_to);
      if (ours) rows.push({ group, low, ours });
    }
  if (rows.length === 0) return null;
  const pair = (get) => (row) => {
    const a = get(row.ours), b = get(row.low);
    if (!is_number(a) || !is_number(b)) return "–";
    return html("span", {}, `${number(a)} against ${number(b)} `,
      html("b", {}, a < b ? "better" : a > b ? "worse" : "equal"));
  };
  const result = table(rows, { title: "scene", get: (row) => row.group.title }, [
    { title: "case", get: (row) => row.ours.case },
    { title: "lowres with equal", get: (row) => row.low.parameters.equal },
    { title: "ms", get: (row) => `${number(row.ours.time_ms.median)} and ` +
                                 number(row.low.time_ms.median) },
    { title: "time ratio", get: (row) => row.low.parameters.time_ratio, plain: true },
    { title: "foveated FLIP", get: pair((c) => c.scores.foveated_flip.mean) },
    { title: "flicker energy", get: pair((c) => c.scores.flicker_energy) },
    { title: "instability", get: pair((c) => c.scores.instability) },
    { title: "FLIP", get: pair((c) => c.scores.flip.mean) },
  ]);
  for (const cell of result.querySelectorAll("td"))
    if (/ (better|worse)$/.test(cell.textContent))
      cell.className = cell.textContent.endsWith("better") ? "yes" : "no";
  return result;
}

// Each case over all scenes: geometric mean of the speed-up, means of the scores.
function summary_table(groups) {
  const rows = distinct(groups.flatMap((g) => g.cases.map((c) => c.case))).map((name) => ({
    name,
    found: groups.map((g) => ({ c: g.cases.find((c) => c.case === name),
                                full: g.cases.find((c) => c.method === "full") }))
      .filter((pair) => pair.c),
  }));
  const over = (get) => (row) => {
    const values = row.found.map((pair) => get(pair.c)).filter(is_number);
    return values.length === 0 ? null : mean(values);
  };
  return table(rows, { title: "case", get: (row) => row.name }, [
    { title: "scenes and lights", get: (row) => row.found.length, plain: true },
    { title: "speed-up", more: true, get: (row) => row.found.every((pair) => pair.full)
      ? Math.exp(mean(row.found.map((pair) =>
          Math.log(pair.full.time_ms.median / pair.c.time_ms.median)))) : null },
    { title: "samples a pixel", plain: true, get: over((c) => c.samples / (c.width * c.height)) },
    { title: "foveated FLIP", get: over((c) => c.scores.foveated_flip.mean) },
    { title: "FLIP", get: over((c) => c.scores.flip.mean) },
    { title: "flicker energy", get: over((c) => c.scores.flicker_energy) },
    { title: "SSIM", more: true, get: over((c) => c.scores.ssim) },
    { title: "inside r0, against full: FLIP", get: over((c) => c.against_full.flip_inside_r0) },
  ]);
}
