// What the page knows: the law's fields and the motion as written, what is plotted, curves kept. It lives in the address.
"use strict";

const START = {
  law: { sphere: "ag-coated-glass", surface: "stainless-steel", normal: "ea", friction: "0.2", roughness_factor: "0.5" },
  motion: { diameter: "70um", speed: "2m/s", angle: "45", spin: "0" },
  over: "speed",
  range: ["0.05", "50"],
  quantity: "restitution",
  kept: [],
  points: [],
  preset: "",
};
const RANGES = { speed: ["0.05", "50"], diameter: ["1um", "1mm"], angle: ["5", "90"] };
const OVERS = ["speed", "diameter", "angle"];
/** Whether it can run along the axis: the motion's, and the law's numbers that have a slider and are no result as well. */
const canRun = (name) => OVERS.includes(name) || (name in SLIDERS && !(name in QUANTITIES) && LISTS.keys.some((k) => k.name === name));
/** Where an axis begins and ends until someone says otherwise. */
const rangeOf = (over) => RANGES[over] ?? [written(over, 0, ""), written(over, STEPS, "")];
const QUANTITIES = { restitution: "restitution e", tangential_restitution: "tangential restitution eₜ", impulse_ratio: "impulse ratio μ" };
const MOST_CURVES = 12;

let state = structuredClone(START);

const isNumber = (text) => /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text.trim());
const asList = (text) => text.split(/[,+]/).map((t) => t.trim()).filter(Boolean);

/** A value as TOML writes it. */
function tomlValue(key, value) {
  const text = value.trim();
  const quoted = JSON.stringify(text);
  if (key === "normal") {
    const names = asList(text);
    return names.length > 1 || LISTS.losses.includes(names[0]) ? JSON.stringify(names).replaceAll('","', '", "') : quoted;
  }
  if (text.startsWith("{")) return text;
  if (isNumber(text)) return text.replace(/^[+]/, "").replace(/^(-?)\./, "$10.").replace(/\.$/, ".0").replace(/\.e/i, ".0e");
  return /^[+-]?inf$/.test(text) ? text : quoted;
}

/** A law's fields as the text that the kernel, the command and the C interface read. */
function toml(law) {
  return Object.entries(law).map(([key, value]) => `${key} = ${tomlValue(key, value)}\n`).join("");
}

/** What is filled in and read: a field that is hidden is not in the law. */
function given(fields) {
  const filled = Object.entries(fields).filter(([, value]) => value.trim() !== "");
  const form = filled.filter(([key]) => ["normal", "tangential", "tangential_restitution", "roughness", "roughness_model"].includes(key));
  let reads;
  try {
    reads = KERNEL.reads(toml(Object.fromEntries(form)));
  } catch (e) {
    if (!(e instanceof Refused)) throw e;
    return Object.fromEntries(filled);
  }
  return Object.fromEntries(filled.filter(([key]) => reads.has(key)));
}

/** The motion in numbers; throws what the kernel says of a field, with the field's name. */
function motion(written, skip) {
  const m = {};
  for (const [name, text] of Object.entries(written)) {
    try {
      m[name] = KERNEL.quantity(name, text.trim() === "" && name === "spin" ? "0" : text);
    } catch (e) {
      if (!(e instanceof Refused)) throw e;
      if (name === skip) { m[name] = NaN; continue; }
      e.field = name;
      e.message = `${name}: ${e.message}`;
      throw e;
    }
  }
  return m;
}

const isOblique = (m) => m.angle !== 90 || m.spin !== 0;

/** The ends of the axis in numbers. */
function ends(s) {
  const [from, to] = s.range.map((text) => {
    try {
      return KERNEL.quantity(s.over, text);
    } catch (e) {
      if (e instanceof Refused) { e.field = "range"; e.message = `axis: ${e.message}`; }
      throw e;
    }
  });
  if (!(from < to)) {
    const e = new Refused(`axis: ${s.range[0]} to ${s.range[1]} does not rise`);
    e.field = "range";
    throw e;
  }
  return [from, to];
}

/** The state as an address. */
function toHash(s) {
  const p = new URLSearchParams();
  Object.entries(s.law).forEach(([k, v]) => v !== "" && p.set(k, v));
  Object.entries(s.motion).forEach(([k, v]) => p.set(k, v));
  p.set("over", s.over);
  p.set("range", s.range.join(".."));
  p.set("quantity", s.quantity);
  if (s.preset) p.set("preset", s.preset);
  if (s.kept.length) p.set("kept", JSON.stringify(s.kept));
  if (s.points.length && !s.preset) p.set("points", s.points.map((q) => q.map((v) => (v === null ? "" : v)).join(":")).join(","));
  return `#${p}`;
}

/** The state of an address; what it does not name is as at the start. Returns null for an address without a law. */
function fromHash(hash) {
  const p = new URLSearchParams(hash.replace(/^#/, ""));
  if (!p.has("normal")) return null;
  const s = { ...structuredClone(START), law: {}, kept: [], points: [] };
  const known = new Set(LISTS.keys.map((k) => k.name));
  p.forEach((value, name) => { if (known.has(name)) s.law[name] = value; });
  Object.keys(s.motion).forEach((k) => p.has(k) && (s.motion[k] = p.get(k)));
  if (canRun(p.get("over"))) s.over = p.get("over");
  const range = (p.get("range") || "").split("..");
  s.range = range.length === 2 ? range : [...rangeOf(s.over)];
  if (QUANTITIES[p.get("quantity")]) s.quantity = p.get("quantity");
  s.preset = PRESETS.some((q) => q.id === p.get("preset")) ? p.get("preset") : "";
  try {
    const kept = JSON.parse(p.get("kept") || "[]");
    s.kept = kept.filter((c) => c && typeof c.label === "string" && typeof c.diameter === "string" && c.law).slice(0, MOST_CURVES);
  } catch {
    s.kept = [];
  }
  const points = (p.get("points") || "").split(",").filter(Boolean).map((q) => q.split(":").map((v) => (v === "" ? null : Number(v))));
  s.points = s.preset ? presetPoints(s.preset) : points.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y));
  return s;
}

const presetPoints = (id) => (PRESETS.find((p) => p.id === id)?.points ?? []).map((q) => [...q]);

/** A preset: its first curve is the law, all its curves are kept beside. */
function usePreset(id) {
  const p = PRESETS.find((q) => q.id === id);
  const [first] = p.curves;
  state = {
    ...structuredClone(START),
    law: { ...first.law },
    motion: { diameter: first.diameter, speed: p.speed || "2m/s", angle: p.over === "angle" ? "45" : "90", spin: "0" },
    over: p.over,
    range: p.range.map(String),
    quantity: p.quantity,
    kept: p.curves.slice(first.to ? 0 : 1).map((c) => structuredClone(c)),
    points: presetPoints(id),
    preset: id,
  };
}
