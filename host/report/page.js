// The page: facts, summary, and a part for each scene and lighting.

const results = JSON.parse(document.getElementById("results").textContent);
const labels = distinct(results.cases.map((c) => c.case));
const figures = []; // to be drawn anew when the measure changes
let measure = kMeasures[0];

for (const c of results.cases) c.index = labels.indexOf(c.case);

const groups = [];
for (const c of results.cases) {
  const title = `${c.scene}, ${c.lights} lights`;
  let group = groups.find((g) => g.title === title);
  if (!group) groups.push(group = { title, id: `part-${groups.length + 1}`, cases: [] });
  group.cases.push(c);
}

function facts() {
  const show = [
    ["device", (c) => c.device], ["driver", (c) => c.driver], ["commit", (c) => c.commit],
    ["display", (c) => `${c.display}, ${c.width} × ${c.height}`],
    ["frames", (c) => `${c.frames} in ${c.segments} stretches, after ${c.warm_up} each`],
    ["gaze", (c) => c.gaze], ["head", (c) => c.head],
    ["reference", (c) => `full, ${c.reference_spp} samples a pixel`], ["seed", (c) => c.seed],
    ["pixels", (c) => `${number(c.pixels_per_degree)} a degree`],
  ];
  document.getElementById("facts").append(...show.map(([name, get]) => html("div", {},
    html("dt", {}, name), html("dd", {}, distinct(results.cases.map(get)).join("; ")))));
}

function measure_choice() {
  const choice = html("select", { id: "measure", onchange: () => {
    measure = kMeasures[choice.selectedIndex];
    for (const f of figures) f.redraw();
  } }, kMeasures.map((m) => html("option", {}, m.name)));
  return html("p", { class: "choice" },
    html("label", { for: "measure" }, "Quality in the plots against time:"), choice);
}

function part(group) {
  const cases = group.cases, key = cases.map((c) => [c.index, c.case]);
  const front = pareto(cases, kMeasures[0]);
  const by_quality = figure("Quality against time",
    (width) => pareto_plot(cases, measure, width),
    html("p", { class: "note" }, "Filled: on the Pareto front (dashed), beaten by no other case ",
      "in time and quality at once."));
  figures.push(by_quality);
  const names = main_stages(cases).map((name, i) => [i, name, "bar"]);
  const has_rest = cases.some((c) => stage_rows(c, names.map((n) => n[1])).at(-1) > 0);
  return html("section", { "aria-labelledby": group.id },
    html("h2", { id: group.id }, group.title),
    html("div", { class: "plots" },
      by_quality,
      figure("Error against eccentricity", (width) => eccentricity_plot(cases, width), [
        legend(key), html("p", { class: "note" }, `Dashed: ${band_limits(cases)}.`)]),
      figure("Time of the stages", (width) => stage_plot(cases, width),
        legend(has_rest ? [...names, [9, "other stages", "bar"]] : names)),
      figure("Flicker over time",
        (width) => series_plot(cases, "flicker_energy", "flicker energy", width), legend(key)),
      figure("FLIP over time", (width) => series_plot(cases, "flip", "FLIP", width), legend(key)),
      figure("Time of each frame", (width) => series_plot(cases, "ms", "ms", width),
        legend(key))),
    html("h3", {}, "Time"), time_table(cases, front),
    html("h3", {}, "Scores"), score_table(cases, front),
    html("h3", {}, "By eccentricity"), band_table(cases, front),
    viewer(cases, results.images));
}

facts();
document.getElementById("contents").append(...groups.map((g) =>
  html("a", { href: `#${g.id}` }, g.title)));
const main = document.getElementById("main");
const equal = equal_table(groups);
main.append(html("h2", {}, "All scenes"), summary_table(groups));
if (equal)
  main.append(html("h3", {}, "Beside fewer pixels, at equal samples and at equal time"), equal);
main.append(measure_choice(), ...groups.map(part));
