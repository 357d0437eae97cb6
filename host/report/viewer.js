// Reference, test and heat map of a case to flip between, with the gaze drawn.

const kShots = [["reference", "Reference"], ["test", "Test"], ["heat_map", "Heat map"]];

// The directions that lie `degrees` from the gaze, as a path over the picture (pixels).
function ring(c, gaze, degrees) {
  const view = c.view;
  const toward = (x, y) => [
    -view.tan_left + x / c.width * (view.tan_left + view.tan_right),
    view.tan_up - y / c.height * (view.tan_up + view.tan_down), -1];
  const unit = (v) => { const n = Math.hypot(...v); return v.map((k) => k / n); };
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                           a[0] * b[1] - a[1] * b[0]];
  const g = unit(toward(...gaze)), u = unit(cross(g, [0, 1, 0])), v = cross(g, u);
  const angle = degrees * Math.PI / 180;
  let path = "", pen = false;
  for (let i = 0; i <= 72; ++i) {
    const turn = i * Math.PI / 36;
    const d = g.map((k, n) => k * Math.cos(angle) +
      (u[n] * Math.cos(turn) + v[n] * Math.sin(turn)) * Math.sin(angle));
    if (d[2] > -0.05) { pen = false; continue; } // beside or behind the eye
    const x = (d[0] / -d[2] + view.tan_left) / (view.tan_left + view.tan_right) * c.width;
    const y = (view.tan_up - d[1] / -d[2]) / (view.tan_up + view.tan_down) * c.height;
    path += `${pen ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = true;
  }
  return path;
}

function gaze_drawing(c, picture) {
  const root = svg("svg", { viewBox: `0 0 ${c.width} ${c.height}`, "aria-hidden": "true",
                            class: "gaze" });
  if (!picture.gaze) return root;
  const [x, y] = picture.gaze, arm = Math.max(c.width, c.height) / 40;
  const cross = `M${x - arm} ${y}H${x - arm / 3}M${x + arm / 3} ${y}H${x + arm}` +
    `M${x} ${y - arm}V${y - arm / 3}M${x} ${y + arm / 3}V${y + arm}`;
  const regions = [c.parameters.r0, c.parameters.r1].filter(is_number);
  const rings = regions.length > 0 ? regions : c.bands.slice(1, 3).map((b) => b.from);
  const path = cross + rings.map((degrees) => ring(c, picture.gaze, degrees)).join("");
  root.append(svg("path", { class: "dark", d: path }), svg("path", { class: "light", d: path }));
  return root;
}

let active_viewer = null; // the one that keys go to

function viewer(cases, images) {
  const shown_cases = cases.filter((c) => c.pictures.length > 0);
  if (shown_cases.length === 0)
    return html("p", { class: "note" }, "These cases came without pictures.");
  const first = shown_cases.findIndex((c) => c.method !== "full"); // where there is most to see
  const state = { c: Math.max(0, first), picture: 0, shot: 1, gaze: true, zoom: 1 };
  const stage = html("div", { class: "stage" });
  const caption = html("p", { class: "note", "aria-live": "polite" });
  const case_choice = html("select", { "aria-label": "Case",
    onchange: () => { state.c = case_choice.selectedIndex; update(); } },
  shown_cases.map((c) => html("option", {}, c.case)));
  const frame_choice = html("select", { "aria-label": "Frame",
    onchange: () => { state.picture = frame_choice.selectedIndex; update(); } });
  const shot_buttons = kShots.map(([, text], i) => html("button", { type: "button",
    onclick: () => { state.shot = i; update(); } }, text));
  const gaze_button = html("button", { type: "button",
    onclick: () => { state.gaze = !state.gaze; update(); } }, "Gaze");
  const zoom_button = html("button", { type: "button",
    onclick: () => { state.zoom = state.zoom === 4 ? 1 : 2 * state.zoom; update(); } });
  const root = html("section", { class: "viewer", tabindex: 0, "aria-label": "Pictures" },
    html("div", { class: "bar" }, case_choice, frame_choice, shot_buttons, gaze_button,
      zoom_button),
    html("div", { class: "scroll" }, stage), caption,
    html("div", { class: "magma" }),
    html("div", { class: "scale" }, html("span", {}, "0"), html("span", {}, "heat map: FLIP"),
      html("span", {}, "1")),
    html("p", { class: "note keys" }, "Keys: 1, 2, 3 reference, test, heat map · space flips ",
      "reference and test · ← → case · F frame · G gaze · Z zoom"));
  let drawn = "";

  function draw(c, picture) {
    stage.replaceChildren(...kShots.map(([key, text]) => html("figure", { class: "shot" },
      html("img", { src: images[picture[key]], alt: `${text}, ${c.case}, frame ${picture.frame}`,
                    width: c.width, height: c.height }),
      gaze_drawing(c, picture), html("figcaption", {}, text))));
    frame_choice.replaceChildren(...c.pictures.map((p) =>
      html("option", {}, `frame ${p.frame}`)));
  }
  function update() {
    const c = shown_cases[state.c];
    state.picture = Math.min(state.picture, c.pictures.length - 1);
    const picture = c.pictures[state.picture];
    if (drawn !== `${state.c} ${state.picture}`) draw(c, picture);
    drawn = `${state.c} ${state.picture}`;
    case_choice.selectedIndex = state.c;
    frame_choice.selectedIndex = state.picture;
    stage.style.width = state.zoom === 1 ? "auto" : `${c.width * state.zoom}px`;
    stage.style.maxWidth = state.zoom === 1
      ? `min(${Math.max(512, c.width * 2)}px, ${(78 * c.width / c.height).toFixed(1)}vh)` : "none";
    [...stage.children].forEach((shot, i) => {
      shot.classList.toggle("shown", i === state.shot);
      shot.querySelector(".gaze").style.display = state.gaze ? "" : "none";
    });
    shot_buttons.forEach((b, i) => b.setAttribute("aria-pressed", i === state.shot));
    gaze_button.setAttribute("aria-pressed", state.gaze);
    zoom_button.textContent = state.zoom === 1 ? "Fit" : `${state.zoom} ×`;
    caption.textContent = `${kShots[state.shot][1]} · ${c.case}, frame ${picture.frame}` +
      ` · ${number(c.time_ms.median)} ms, FLIP ${number(c.scores.flip.mean)}, ` +
      `foveated ${number(c.scores.foveated_flip.mean)}`;
  }
  root.press = (key) => {
    const turn = (value, count, step) => (value + step + count) % count;
    if ("123".includes(key)) state.shot = Number(key) - 1;
    else if (key === " ") state.shot = state.shot === 1 ? 0 : 1;
    else if (key === "ArrowRight") state.c = turn(state.c, shown_cases.length, 1);
    else if (key === "ArrowLeft") state.c = turn(state.c, shown_cases.length, -1);
    else if (key === "f") state.picture = turn(state.picture,
      shown_cases[state.c].pictures.length, 1);
    else if (key === "g") gaze_button.click();
    else if (key === "z") zoom_button.click();
    else return false;
    update();
    return true;
  };
  for (const event of ["pointerenter", "focusin"])
    root.addEventListener(event, () => { active_viewer = root; });
  if (!active_viewer) active_viewer = root;
  update();
  return root;
}

document.addEventListener("keydown", (event) => {
  const takes_keys = event.target instanceof Element &&
    event.target.matches("select, input, textarea, button");
  if (event.ctrlKey || event.altKey || event.metaKey || !active_viewer) return;
  const plain = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const of_element = takes_keys && (plain === " " || plain.startsWith("Arrow") ||
    event.target.matches("select"));
  const of_page = (plain === " " || plain.startsWith("Arrow")) &&
    !active_viewer.contains(event.target);
  if (!of_element && !of_page && active_viewer.press(plain)) event.preventDefault();
});
