// The form: one field for each input, with its slider, its equation, its source, its error.
"use strict";

const UNITS = { nm: 1e-9, um: 1e-6, "µm": 1e-6, mm: 1e-3, cm: 1e-2, m: 1, "mm/s": 1e-3, "m/s": 1, Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9, "J/m2": 1, "mJ/m2": 1e-3, "s/m": 1, "ms/m": 1e-3, deg: 1, "rad/s": 1, J: 1, "": 1 };
/** Sliders: from, to, unit of the texts they write, and whether in equal ratios. */
const SLIDERS = {
  diameter: [1e-7, 1e-2, "um", true], speed: [1e-3, 300, "m/s", true], angle: [1, 90, "", false, 1], spin: [-1e5, 1e5, "", false, 100],
  friction: [0, 1, "", false, 0.01], walton_beta: [0, 1, "", false, 0.01], roughness_factor: [0.01, 1, "", false, 0.01],
  roughness: [5e-11, 1e-8, "nm", true], asperity_radius: [1e-8, 1e-5, "nm", true], roughness_angle: [0, 20, "deg", false, 0.5],
  adhesion_damping: [0, 5, "", false, 0.01], hertz_damping: [0, 0.1, "", false, 0.0005], restitution: [0, 1, "", false, 0.01],
  tangential_restitution: [0, 1, "", false, 0.01], yield_velocity: [1e-3, 100, "m/s", true], meyer_index: [1.6, 2.95, "", false, 0.01],
  limiting_pressure: [1e7, 1e10, "MPa", true], interfacial_parameter: [0.1, 2, "", false, 0.01], equilibrium_spacing: [1e-10, 1e-9, "nm", true],
  work_of_adhesion: [1e-3, 10, "J/m2", true], stiffness: [1e6, 1e12, "GPa", true], plastic_constant: [1e6, 1e10, "MPa", true],
  dynamic_strength_factor: [0.5, 5, "", false, 0.1], well_depth: [1e-20, 1e-10, "J", true], well_depth_out: [1e-20, 1e-10, "J", true],
  hamaker_constant: [1e-21, 1e-18, "J", true],
};
const CHOICES = { adhesion: ["separation-only", "reversible"], roughness_model: ["rabinovich", "fuller-tabor"] };
const MOTION = {
  diameter: ["d", "sphere's diameter"], speed: ["v", "speed of approach"],
  angle: ["α", "angle from the surface, degrees; 90 is head-on"], spin: ["ω", "spin, rad/s; positive rolls forward"],
};
const STEPS = 400;

/** A text as a number in SI units, for the slider's place alone; the kernel reads the text itself. */
function roughly(text) {
  const found = /^\s*([+-]?[\d.]+(?:e[+-]?\d+)?)\s*(.*?)\s*$/i.exec(text ?? "");
  return found && UNITS[found[2]] !== undefined ? Number(found[1]) * UNITS[found[2]] : NaN;
}

function place(key, text) {
  const [from, to, , ratios] = SLIDERS[key], v = roughly(text);
  if (!Number.isFinite(v)) return 0;
  const share = ratios ? Math.log(v / from) / Math.log(to / from) : (v - from) / (to - from);
  return Math.round(STEPS * Math.min(1, Math.max(0, share)));
}

/** What a slider writes, in the unit that the box has already if it has one. */
function written(key, at, before) {
  const [from, to, unit, ratios, step] = SLIDERS[key], share = at / STEPS;
  let v = ratios ? from * (to / from) ** share : from + share * (to - from);
  if (step) v = Math.round(v / step) * step;
  const old = /[\d.]\s*([a-zµ/][\w/µ]*)\s*$/i.exec(before ?? "")?.[1];
  const now = old && UNITS[old] && (key === "speed" || UNITS[unit] !== undefined) && !/^e\d/i.test(old) ? old : unit;
  return `${Number((v / UNITS[now]).toPrecision(3))}${now}`;
}

const label = (text) => text.replaceAll("_", " ");

function fieldHtml(key, kind) {
  const info = kind === "motion" ? { symbol: MOTION[key][0], meaning: MOTION[key][1], unit: "", default: "" } : LISTS.keys.find((k) => k.name === key);
  const id = `${kind}-${key}`;
  const wanted = info.default ? `${info.default} unless given` : "";
  const box = CHOICES[key]
    ? `<select id="${id}" data-kind="${kind}" data-key="${key}"><option value="">${escapeXml(info.default)} (default)</option>${CHOICES[key].map((c) => `<option>${c}</option>`).join("")}</select>`
    : `<input id="${id}" data-kind="${kind}" data-key="${key}" autocomplete="off" spellcheck="false" placeholder="${escapeXml(info.default ?? "")}" aria-describedby="${id}-about ${id}-error"${["sphere", "surface"].includes(key) ? ' list="materials"' : ""}>`;
  const slider = SLIDERS[key] ? `<input type="range" min="0" max="${STEPS}" data-slides="${id}" aria-label="${escapeXml(label(key))}, slider">` : "";
  const unit = info.unit ? `, ${info.unit}` : "";
  return `<div class="field" id="field-${id}"><label for="${id}"><b>${escapeXml(label(key))}</b>${info.symbol ? ` <i>${escapeXml(info.symbol)}</i>` : ""}${escapeXml(unit)}</label>
<div class="inputs">${box}${slider}</div><p class="error" id="${id}-error" role="alert"></p>
<p class="about" id="${id}-about">${escapeXml(info.meaning)}${wanted ? ` (${escapeXml(wanted)})` : ""}<br>${equation(KEYS[key])}</p></div>`;
}

/** Makes the form once; later only its values change. */
function buildForm() {
  const options = (names) => names.map((n) => `<option>${n}</option>`).join("");
  document.getElementById("preset").innerHTML = `<option value="">your own</option>${PRESETS.map((p) => `<option value="${p.id}">${escapeXml(p.name)}</option>`).join("")}`;
  document.getElementById("law-normal").innerHTML = `${options(LISTS.laws)}<option value="losses">a list of losses</option>`;
  document.getElementById("law-tangential").innerHTML = `<option value="">rolling (default)</option>${options(LISTS.tangential.filter((t) => t !== "rolling"))}`;
  document.getElementById("materials").innerHTML = options(LISTS.materials.map((m) => m.name));
  document.getElementById("losses-known").textContent = LISTS.losses.join(", ");
  const put = (id, html) => { document.getElementById(id).innerHTML = html; };
  put("fields-materials", ["sphere", "surface"].map((k) => fieldHtml(k, "law")).join(""));
  put("fields-motion", Object.keys(MOTION).map((k) => fieldHtml(k, "motion")).join(""));
  const others = LISTS.keys.map((k) => k.name).filter((k) => !["sphere", "surface", "normal", "tangential"].includes(k));
  const first = ["restitution", "yield_velocity", "meyer_index", "well_depth", "hamaker_constant", "friction", "walton_beta", "tangential_restitution", "roughness_factor", "adhesion_damping", "hertz_damping", "adhesion"];
  put("fields-law", first.map((k) => fieldHtml(k, "law")).join(""));
  put("fields-more", others.filter((k) => !first.includes(k)).map((k) => fieldHtml(k, "law")).join(""));
  document.getElementById("more").open = Object.keys(state.law).some((k) => others.includes(k) && !first.includes(k));
  document.getElementById("quantity").innerHTML = Object.entries(QUANTITIES).map(([k, words]) => `<option value="${k}">${words}</option>`).join("");
}

/** The form shows the state; a box that is being written in is left alone. */
function showForm() {
  const set = (id, value) => {
    const node = document.getElementById(id);
    if (node !== document.activeElement || node.tagName === "SELECT") node.value = value ?? "";
  };
  const normal = state.law.normal ?? "ea", named = LISTS.laws.includes(normal);
  set("law-normal", named ? normal : "losses");
  set("law-losses", named ? "" : normal);
  document.getElementById("losses").hidden = named;
  set("law-tangential", state.law.tangential ?? "");
  set("preset", state.preset);
  set("quantity", state.quantity);
  set("range-from", state.range[0]);
  set("range-to", state.range[1]);
  document.getElementById("law-equation").innerHTML = equation(LAWS[named ? normal : "losses"]);
  document.getElementById("tangential-equation").innerHTML = equation(TANGENTIALS[state.law.tangential || (state.law.tangential_restitution ? "constant" : "rolling")]);
  document.querySelectorAll("[data-kind]").forEach((node) => set(node.id, state[node.dataset.kind][node.dataset.key]));
  document.querySelectorAll("[data-slides]").forEach((slider) => {
    const { kind, key } = document.getElementById(slider.dataset.slides).dataset;
    if (slider !== document.activeElement) slider.value = place(key, state[kind][key]);
    slider.setAttribute("aria-valuetext", state[kind][key] || "default");
  });
  let reads = null;
  try {
    const form = Object.fromEntries(["normal", "tangential", "tangential_restitution", "roughness", "roughness_model"].filter((k) => state.law[k]).map((k) => [k, state.law[k]]));
    reads = KERNEL.reads(toml(form));
  } catch (e) {
    if (!(e instanceof Refused)) throw e;
  }
  const runs = LISTS.keys.map((k) => k.name).filter((k) => canRun(k) && (k === state.over || reads === null || reads.has(k)));
  const options = (names) => names.map((n) => `<option value="${n}">${label(n)}</option>`).join("");
  const over = document.getElementById("over"), choices = `<optgroup label="impact">${options(OVERS)}</optgroup><optgroup label="law">${options(runs)}</optgroup>`;
  // not while it is open and nothing has changed
  if (over.dataset.choices !== choices) { over.innerHTML = choices; over.dataset.choices = choices; }
  set("over", state.over);
  document.querySelectorAll("#fields-law .field, #fields-more .field").forEach((node) => {
    const { key } = node.querySelector("[data-key]").dataset;
    node.hidden = reads !== null && !reads.has(key);
  });
  ["sphere", "surface"].forEach((key) => {
    const name = (state.law[key] ?? "").trim().toLowerCase().replace(/[ _]/g, "-");
    const m = LISTS.materials.find((n) => n.name === name || (n.aliases ?? []).includes(name));
    document.getElementById(`about-${key}`).innerHTML = m ? materialHtml(key, m) : "";
  });
}

function materialHtml(key, m) {
  const rows = Object.values(m.has ?? {}).map((p) => {
    const from = p.source ?? (p.typical ? `typical: ${p.typical}` : "");
    const linked = escapeXml(from).replace(/https:\/\/doi\.org\/[^\s,;]+/g, (u) => `<a href="${u}">${u.slice(16)}</a>`);
    return `<tr><th>${escapeXml(p.noun)}</th><td>${prefixed(p.value, p.unit ?? "").replace(/ kkg/, "×10³ kg")}</td><td>${linked}${p.note ? `<br><small>${escapeXml(p.note)}</small>` : ""}</td></tr>`;
  });
  return `<details><summary>${key}: ${escapeXml(m.name)}, values and sources</summary><table>${rows.join("")}</table></details>`;
}
