// What people do: fields, sliders, presets, files, copies, pictures.
"use strict";

/** Keys of which a law has one. */
const ONE_OF = { roughness: "roughness_factor", roughness_factor: "roughness", well_depth: "hamaker_constant", hamaker_constant: "well_depth" };

function own() {
  if (!state.preset) return;
  // a law of one's own keeps the preset's curves and points to compare with
  state.points = state.points.length ? state.points : presetPoints(state.preset);
}

function edit(kind, key, value) {
  own();
  if (value.trim() === "") delete state[kind][key];
  else state[kind][key] = value;
  if (kind === "motion" && value.trim() === "") state.motion[key] = "";
  // each says what the other says
  const other = ONE_OF[key];
  if (kind === "law" && other && value.trim() !== "") delete state.law[other];
  changed();
}

function save(name, type, text) {
  const a = document.createElement("a");
  a.href = URL.createObjectURL(new Blob([text], { type }));
  a.download = name;
  a.click();
  setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}

/** A picture that stands alone: the page's colours as they are now. */
function standalone(id) {
  const svg = document.getElementById(id).querySelector("svg");
  if (!svg) return null;
  const css = getComputedStyle(document.documentElement);
  const value = (name) => css.getPropertyValue(name).trim();
  const style = document.getElementById("figure-style").textContent.replace(/var\((--[\w-]+)\)/g, (_, n) => value(n));
  const [, , w, h] = svg.getAttribute("viewBox").split(" ");
  const legendItems = [...document.querySelectorAll(`#${id}-legend li`)].map((li) => li.textContent);
  const body = svg.outerHTML.replace(/var\((--[\w-]+)\)/g, (_, n) => value(n)).replace("<svg ", `<svg width="${w}" height="${h}" `)
    .replace(/(<svg[^>]*>)/, `$1<title>${escapeXml(legendItems.join("; "))}</title><style>${style} text{fill:${value("--ink")}}</style><rect width="100%" height="100%" fill="${value("--ground")}"/>`);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${body}\n`;
}

/** What runs, as the head of a column: its name and unit, as the command writes them. */
function runningHead(over) {
  if (over === "angle") return "angle_deg";
  const unit = { speed: "m/s", diameter: "m" }[over] ?? LISTS.keys.find((k) => k.name === over).unit;
  return unit ? `${over} (${unit})` : over;
}

/** The table of a figure, SI units, with every digit. */
function csvOf(id) {
  const { s, own: mine, kept } = SHOWN;
  const head = [runningHead(s.over), "fate", "restitution", "normal_speed_out (m/s)", "tangential_speed_out (m/s)", "spin_out (rad/s)", "angle_out_deg", "impulse_ratio", "tangential_restitution", "contact", ...LISTS.energy.map((e) => `energy_${e}`), "validity"];
  const words = (r) => Array.from(r, (v, i) => {
    if (i === ROW.fate) return v ? "rebound" : "capture";
    if (i === ROW.contact) return ["none", "sliding", "rolling", "micro-slip"][v];
    if (i === ROW.validity) return LISTS.validity.filter((c) => v & c.bit).map((c) => c.code).join(" ");
    return Number.isNaN(v) ? "NaN" : String(v);
  });
  if (id === "energy") return [head, ...mine.rows.map(words)].map((r) => r.join(",")).join("\n");
  const quoted = (t) => `"${t.replaceAll('"', '""')}"`;
  const curves = [["this law", mine], ...kept.flatMap((k) => [[k.label, k.low], ...(k.high ? [[`${k.label} (upper)`, k.high]] : [])])];
  return [["curve", ...head], ...curves.flatMap(([name, c]) => c.rows.map((r) => [quoted(name), ...words(r)]))].map((r) => r.join(",")).join("\n");
}

/** What the worker computed, as a table: the map's cells, or the contact's moments. */
function slowCsv(id) {
  const { map, moments } = SHOWN;
  if (id === "history") {
    const rows = Array.from({ length: (moments?.length ?? 0) / 6 }, (_, i) => moments.slice(6 * i, 6 * i + 6).join(","));
    return ["time (s),overlap (m),speed (m/s),hertz_force (N),net_force (N),slip (m/s)", ...rows].join("\n");
  }
  const at = (n, [a, b]) => Array.from({ length: n }, (_, i) => (i === 0 ? a : i === n - 1 ? b : a * (b / a) ** (i / (n - 1))));
  const rows = map ? at(map.rows, map.diameters).flatMap((d, j) => at(map.columns, map.speeds).map((v, i) => {
    const k = 2 * (j * map.columns + i);
    return [d, v, REGIONS[map.cells[k]][0], LISTS.validity.filter((c) => map.cells[k + 1] & c.bit).map((c) => c.code).join(" ")].join(",");
  })) : [];
  return ["diameter (m),speed (m/s),region,validity", ...rows].join("\n");
}

/** The spread of a wall that scatters, as the command's columns. */
function spreadCsv() {
  const { s, spread } = SHOWN;
  const head = [runningHead(s.over), "sticking_probability", ...["restitution", "tangential_restitution", "impulse_ratio"].flatMap((q) => ["median", "p05", "p95"].map((end) => `${q}_${end}`))];
  const rows = Array.from({ length: spread.length / SPREAD.columns }, (_, i) => spread.slice(i * SPREAD.columns, (i + 1) * SPREAD.columns).join(","));
  return [head.join(","), ...rows].join("\n");
}

/** What a unit in a column's head, as in "speed (cm/s)", makes of its numbers; 1 without a unit. */
function unitOf(head) {
  const unit = /\(\s*([^)]*?)\s*\)$/.exec(head)?.[1];
  if (!unit || (state.over === "angle" && /^(°|deg|degrees)$/i.test(unit))) return 1;
  try {
    return KERNEL.quantity(state.over, `1 ${unit}`);
  } catch (e) {
    if (e instanceof Refused) e.message = `the column '${head}': ${e.message}`;
    throw e;
  }
}

/** Points of a CSV file with a head of names, as `carom fit` reads them: what runs, the quantity, and sigma. */
function readPoints(text) {
  const lines = text.split(/\r?\n/).filter((l) => l.trim() && !l.startsWith("#"));
  if (lines.length < 2) throw new Refused("a line of names and a line for each point are wanted, such as: speed,restitution");
  const split = (l) => l.split(/[,;\t]/).map((c) => c.trim().replace(/^"|"$/g, ""));
  const heads = split(lines[0]), names = heads.map((n) => n.toLowerCase().replace(/\s*\(.*\)$/, "").replace(/[ -]/g, "_"));
  const column = (...any) => names.findIndex((n) => any.includes(n));
  const overs = { speed: ["speed", "v", "velocity"], diameter: ["diameter", "d"], angle: ["angle", "angle_deg"] };
  const x = column(...(overs[state.over] ?? [state.over]));
  const quantity = names.includes(state.quantity) ? state.quantity : Object.keys(QUANTITIES).find((q) => names.includes(q)) ?? (names.includes("e") ? "restitution" : null);
  const y = quantity === null ? -1 : column(quantity, ...(quantity === "restitution" ? ["e"] : []));
  if (x < 0 || y < 0) throw new Refused(`columns ${state.over} and ${state.quantity} are wanted; the file has ${names.join(", ")}`);
  const s = column("sigma", "uncertainty");
  const factor = unitOf(heads[x]);
  const points = lines.slice(1).map((l, i) => {
    const cells = split(l), number = (c) => (cells[c] === undefined || cells[c] === "" ? NaN : Number(cells[c]));
    const [px, py, ps] = [number(x), number(y), s < 0 ? NaN : number(s)];
    if (!Number.isFinite(px) || !Number.isFinite(py)) throw new Refused(`line ${i + 2} of the points: '${l.slice(0, 40)}' has no number where one is wanted`);
    return [px * factor, py, Number.isFinite(ps) ? ps : null];
  });
  if (points.length > 2000) throw new Refused(`${points.length} points: 2000 at most`);
  return { points, quantity };
}

function takePoints(text) {
  try {
    const { points, quantity } = readPoints(text);
    Object.assign(state, { points, quantity, preset: "" });
    say(`${points.length} points`);
    changed();
  } catch (e) {
    if (!(e instanceof Refused)) throw e;
    showError(Object.assign(e, { field: "points" }));
  }
}

function listen() {
  const by = (id) => document.getElementById(id);
  document.querySelector("form").addEventListener("submit", (e) => e.preventDefault());
  document.querySelectorAll("[data-kind]").forEach((n) => n.addEventListener("input", () => edit(n.dataset.kind, n.dataset.key, n.value)));
  document.querySelectorAll("[data-slides]").forEach((slider) => slider.addEventListener("input", () => {
    const box = by(slider.dataset.slides);
    edit(box.dataset.kind, box.dataset.key, written(box.dataset.key, Number(slider.value), box.value));
  }));
  by("law-normal").addEventListener("change", (e) => edit("law", "normal", e.target.value === "losses" ? "plastic-kadomtsev, adhesion-work" : e.target.value));
  by("law-losses").addEventListener("input", (e) => edit("law", "normal", e.target.value));
  by("law-tangential").addEventListener("change", (e) => edit("law", "tangential", e.target.value));
  by("preset").addEventListener("change", (e) => {
    if (e.target.value) usePreset(e.target.value);
    else Object.assign(state, { preset: "", kept: [], points: [] });
    changed();
  });
  by("over").addEventListener("change", (e) => {
    const other = ONE_OF[e.target.value];
    if (other && state.law[other]) delete state.law[other];
    Object.assign(state, { over: e.target.value, range: [...rangeOf(e.target.value)], points: [], kept: state.preset ? [] : state.kept, preset: "" });
    changed();
  });
  by("quantity").addEventListener("change", (e) => { Object.assign(state, { quantity: e.target.value, points: [], preset: "" }); changed(); });
  ["from", "to"].forEach((end, i) => by(`range-${end}`).addEventListener("input", (e) => { state.range[i] = e.target.value; changed(); }));
  by("keep").addEventListener("click", () => {
    if (!SHOWN || state.kept.length >= MOST_CURVES) { say(`${MOST_CURVES} curves at most`); return; }
    state.kept.push({ label: `${SHOWN.law.sphere ?? "sphere"} on ${SHOWN.law.surface ?? "wall"}, ${SHOWN.law.normal}, ${state.motion.diameter}`, law: { ...SHOWN.law }, diameter: state.motion.diameter });
    changed();
  });
  by("drop").addEventListener("click", () => { Object.assign(state, { kept: [], points: [], preset: "" }); changed(); });
  by("points").addEventListener("change", async (e) => { if (e.target.files[0]) takePoints(await e.target.files[0].text()); e.target.value = ""; });
  document.addEventListener("dragover", (e) => { e.preventDefault(); document.body.classList.add("dragging"); });
  document.addEventListener("dragleave", (e) => { if (!e.relatedTarget) document.body.classList.remove("dragging"); });
  document.addEventListener("drop", async (e) => {
    e.preventDefault();
    document.body.classList.remove("dragging");
    const [file] = e.dataTransfer.files;
    if (file) takePoints(await file.text());
  });
  document.querySelectorAll('[name="as"]').forEach((n) => n.addEventListener("change", () => SHOWN && showCopy()));
  by("copy").addEventListener("click", async () => {
    const text = by("copied-text").textContent;
    try {
      await navigator.clipboard.writeText(text);
      say("copied");
    } catch {
      getSelection().selectAllChildren(by("copied-text"));
      say("selected: copy it with your keyboard");
    }
  });
  document.querySelectorAll("[data-save]").forEach((n) => n.addEventListener("click", () => {
    const [id, kind] = n.dataset.save.split(".");
    const tables = { map: slowCsv, history: slowCsv, spread: spreadCsv };
    if (kind === "csv") save(`carom-${id}.csv`, "text/csv", `${(tables[id] ?? csvOf)(id)}\n`);
    else if (standalone(id)) save(`carom-${id}.svg`, "image/svg+xml", standalone(id));
  }));
  by("theme").addEventListener("click", () => {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const now = document.documentElement.dataset.theme ?? (dark ? "dark" : "light");
    document.documentElement.dataset.theme = now === "dark" ? "light" : "dark";
    if (SHOWN) changed();
  });
  addEventListener("hashchange", () => { const s = fromHash(location.hash); if (s) { state = s; redraw(); } });
  let width = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; changed(); } });
}

start().catch((e) => {
  const box = document.getElementById("problem");
  box.hidden = false;
  box.textContent = `The explorer could not start: ${e.message}. It needs a browser with WebAssembly (any since 2019).`;
  throw e;
});
