// The page at work: starts the kernel, reads the form, draws, keeps the address.
"use strict";

let KERNEL = null, LISTS = null, WORKER = null, SHOWN = null;
const put = (id, html) => { document.getElementById(id).innerHTML = html; };
const say = (text) => { document.getElementById("status").textContent = text; };
let jobs = 0, waiting = new Map();

/** A worker made of the page's own text; where that is refused, the page computes itself, in turn. */
function startWorker(bytes) {
  const text = `${document.getElementById("kernel-source").textContent}\nworkerMain();`;
  try {
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    const worker = new Worker(url);
    worker.onerror = (e) => {
      e.preventDefault?.();
      WORKER = null;
      waiting.forEach(({ job, done }) => done(slowly(KERNEL, job)));
      waiting.clear();
    };
    worker.onmessage = ({ data }) => {
      waiting.get(data.id)?.done(data);
      waiting.delete(data.id);
    };
    worker.postMessage({ bytes });
    WORKER = worker;
  } catch {
    WORKER = null;
  }
}

function ask(job) {
  jobs += 1;
  const id = jobs;
  if (!WORKER) return new Promise((done) => { setTimeout(() => done(slowly(KERNEL, job))); });
  return new Promise((done) => {
    waiting.set(id, { job, done });
    WORKER.postMessage({ id, job });
  });
}

/** Everything that is quick, computed from the state; throws Refused. */
function compute() {
  const law = given(state.law), m = motion(state.motion, state.over);
  const span = ends(state);
  if (OVERS.includes(state.over) && !Number.isFinite(m[state.over])) m[state.over] = Math.sqrt(span[0] * span[1]);
  const here = m[state.over] ?? (law[state.over] ? KERNEL.quantity(state.over, law[state.over]) : NaN);
  const oblique = isOblique(m) || state.over === "angle";
  KERNEL.law(0, toml(law), oblique);
  const row = KERNEL.sweep(0, "angle", 2, m.angle, m.angle, true, m)[0];
  const kept = state.kept.map((k) => {
    const km = { ...m, diameter: KERNEL.quantity("diameter", k.diameter) };
    const of = (fields) => { KERNEL.law(1, toml(fields), oblique); return rowsOf(1, state, km, span); };
    return { ...k, low: of(k.law), high: k.to ? of(k.to) : null };
  });
  return { s: state, law, m, span, here, oblique, row, own: rowsOf(0, state, m, span), kept, figures: KERNEL.figures(0, m), pointsFrom: pointsFrom() };
}

const pointsFrom = () => PRESETS.find((p) => p.id === state.preset)?.pointsFrom ?? "your points";

function showError(e) {
  document.querySelectorAll(".error").forEach((n) => { n.textContent = ""; });
  document.querySelectorAll("[aria-invalid]").forEach((n) => n.removeAttribute("aria-invalid"));
  const box = document.getElementById("problem");
  box.hidden = !e;
  document.getElementById("figures").classList.toggle("stale", Boolean(e));
  if (!e) return;
  box.textContent = e.message;
  const named = e.field ?? LISTS.keys.map((k) => k.name).sort((a, b) => b.length - a.length).find((k) => e.message.includes(`'${label(k)}'`) || e.message.includes(`${label(k)}: `));
  const node = document.getElementById(`motion-${named}`) ?? document.getElementById(`law-${named}`) ?? document.getElementById("range-from");
  if (!named || !node) return;
  node.setAttribute("aria-invalid", "true");
  const under = document.getElementById(`${node.id}-error`);
  if (under) under.textContent = e.message;
}

function tellFigures({ figures: f, m, row }) {
  const e = row[ROW.fate] ? `rebounds, e = ${short(row[ROW.restitution], 5)}` : "is captured";
  put("verdict", `The sphere <b>${escapeXml(e)}</b>.`);
  const rows = [
    ["capture velocity", f.capture === 0 ? "0: this law captures nothing" : Number.isFinite(f.capture) ? prefixed(f.capture, "m/s") : "none: captured at every speed", "normal speed"],
    ["exhausted above", Number.isFinite(f.exhausted) && prefixed(f.exhausted, "m/s"), "the end of the model"],
    ["yield velocity", f.yield > 0 && prefixed(f.yield, "m/s"), "of the law"],
    ["yield velocity of the materials", !(f.yield > 0) && f.material_yield > 0 && f.material_yield < 1e3 && prefixed(f.material_yield, "m/s"), "no plastic loss in the law"],
    ["critical angle", Number.isFinite(f.critical_angle) && `${short(f.critical_angle)}°`, "slides to the end below"],
    ["roughness factor", f.roughness_factor !== 1 && short(f.roughness_factor), "C_R in force"],
    ["stiffness", Number.isFinite(f.stiffness) && prefixed(f.stiffness, "Pa"), "K"],
    ["work of adhesion", Number.isFinite(f.work_of_adhesion) && prefixed(f.work_of_adhesion, "J/m²"), "w"],
    ["Tabor's parameter", Number.isFinite(f.tabor) && short(f.tabor), f.tabor > 5 ? "JKR" : f.tabor < 0.1 ? "DMT" : "transition"],
  ].filter(([, v]) => v);
  put("numbers", rows.map(([a, b, c]) => `<tr><th>${a}</th><td${b.length < 14 ? ' class="short"' : ""}>${escapeXml(b)}</td><td>${c}</td></tr>`).join(""));
  put("warnings", f.warnings.map((w) => `<li><b>${w.code}</b>: ${escapeXml(w.words)}</li>`).join(""));
  document.getElementById("warned").hidden = f.warnings.length === 0;
}

let turn = 0;

/** Draws what is quick at once, and asks for what is slow. */
function redraw() {
  showForm();
  history.replaceState(null, "", toHash(state));
  let shown;
  try {
    shown = compute();
  } catch (e) {
    if (!(e instanceof Refused)) throw e;
    showError(e);
    turn += 1;
    return;
  }
  showError(null);
  SHOWN = shown;
  tellFigures(shown);
  drawCurves(shown);
  drawEnergy(shown);
  drawRebound(shown);
  showCopy();
  showAbout();
  turn += 1;
  slow(shown, turn).catch((e) => { throw e; });
}

async function slow(shown, mine) {
  const base = { law: toml(shown.law), oblique: shown.oblique, m: shown.m };
  const resolved = state.law.normal === "resolved";
  const [columns, rows] = resolved ? [40, 28] : [120, 80];
  const speeds = shown.s.over === "speed" ? shown.span : [0.01, 100], d = shown.m.diameter;
  const diameters = shown.s.over === "diameter" ? shown.span : [Math.max(1e-10, d / 30), Math.min(1, d * 30)];
  document.getElementById("history-figure").hidden = !resolved;
  const scatters = OVERS.includes(shown.s.over) && KERNEL.scatters(0);
  if (scatters) {
    const job = { ...base, what: "spread", over: shown.s.over, count: SPREAD.points, span: shown.span, linear: isLinear(shown.s.over, shown.span[0]), samples: SPREAD.samples };
    const { spread } = await ask(job);
    if (mine !== turn) return;
    if (spread) { shown.spread = spread; drawCurves(shown); }
  }
  document.getElementById("spread-save").hidden = !shown.spread;
  const asked = [ask({ ...base, what: "map", columns, rows, speeds, diameters })];
  if (resolved) asked.unshift(ask({ ...base, what: "history" }));
  const [first, second] = await Promise.all(asked);
  if (mine !== turn) return;
  const map = second ?? first;
  Object.assign(shown, { map: map.cells && { columns, rows, speeds, diameters, cells: map.cells }, moments: second && first.moments });
  if (map.refused) { put("map", `<p class="none">${escapeXml(map.refused)}</p>`); put("map-legend", ""); } else drawMap(shown, columns, rows, speeds, diameters, map.cells);
  if (second) {
    if (first.refused) { put("history", `<p class="none">${escapeXml(first.refused)}</p>`); put("history-legend", ""); } else drawHistory(first.moments);
  }
  document.body.dataset.drawn = String(mine);
}

/** Draws at most once a frame. */
let pending = false;
function changed() {
  if (pending) return;
  pending = true;
  requestAnimationFrame(() => { pending = false; redraw(); });
}

function showCopy() {
  const kind = document.querySelector('[name="as"]:checked').value;
  document.getElementById("copied-text").textContent = copyText(kind, SHOWN.law, state);
}

function showAbout() {
  const p = PRESETS.find((q) => q.id === state.preset);
  put("about-preset", p ? `<b>${escapeXml(p.title)}</b>. ${escapeXml(p.source)}. ${p.points.length ? `Points: ${escapeXml(p.pointsFrom)}.` : `Measured points: ${escapeXml(p.valuesFrom)}.`} ${p.notes.map(escapeXml).join(" ")}`.replace(/https:\/\/doi\.org\/[^\s,;]+?(?=[.,;]?(\s|$))/g, (u) => `<a href="${u}">doi:${u.slice(16)}</a>`) : "");
}

async function start() {
  const t0 = performance.now();
  const bytes = await gunzip(fromBase64(document.getElementById("kernel-bytes").textContent));
  KERNEL = await Kernel.from(bytes);
  LISTS = KERNEL.lists();
  state = fromHash(location.hash) ?? state;
  buildForm();
  listen();
  redraw();
  document.body.dataset.ready = String(Math.round(performance.now()));
  document.body.dataset.took = String(Math.round(performance.now() - t0));
  say(`carom ${LISTS.version}: ready`);
  startWorker(bytes);
}
