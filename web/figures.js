// The figures: curves, energy, map, rebound, contact in time.
"use strict";

const POINTS = 200; // as the command
const SPREAD = { points: 60, samples: 400, columns: 11, color: "#E69F00", stick: "#D55E00" };
const ENERGY = { kept: "#56B4E9", adhesion: "#D55E00", adhesion_damping: "#E69F00", hertz_damping: "#F0E442", plastic: "#CC79A7", other: "#999999", friction: "#009E73", captured: "#555555" };
const ENERGY_WORDS = { kept: "kept", adhesion: "adhesion", adhesion_damping: "adhesion damping", hertz_damping: "Hertz damping", plastic: "plastic", other: "given by the table", friction: "friction", captured: "left at capture" };
const REGIONS = [["capture", "#D55E00"], ["rebound", "#56B4E9"], ["rebound with yield", "#CC79A7"]];
/** Yield has its own colour in the map; all other codes are doubts about the model's range. */
const outside = (bits) => bits & ~(codeBit("above-yield"));
const codeBit = (code) => LISTS.validity.find((v) => v.code === code).bit;

function axisOf(over, from, to) {
  if (over === "angle") return { from, to, log: false, label: "angle of incidence from the surface, °" };
  if (over === "speed") return { from, to, log: true, label: "speed, m/s" };
  const key = LISTS.keys.find((k) => k.name === over);
  if (key) return { from, to, log: from > 0, label: `${label(over)}${key.unit ? `, ${key.unit}` : ""}` };
  const middle = Math.sqrt(from * to);
  const [unit, factor] = middle < 5e-7 ? ["nm", 1e9] : middle < 1e-3 ? ["µm", 1e6] : ["mm", 1e3];
  return { from, to, log: true, factor, label: `diameter, ${unit}` };
}

/** Equal steps, as the command takes them: an angle, and what has no ratio. */
const isLinear = (over, from) => over === "angle" || from <= 0;

/** The rows of a law along the axis: the command's points, and a few more above capture, where the curve is steep, for the eye. */
function rowsOf(slot, s, m, [from, to]) {
  const linear = isLinear(s.over, from);
  const rows = KERNEL.sweep(slot, s.over, POINTS, from, to, linear, m);
  let drawn = rows;
  if (s.over === "speed") {
    const v = KERNEL.figures(slot, { ...m, speed: to }).capture / Math.sin((m.angle * Math.PI) / 180);
    if (v > from && v * 1.05 < to) {
      const more = KERNEL.sweep(slot, "speed", 24, v * (1 + 1e-9), v * 1.05, false, m).concat(KERNEL.sweep(slot, "speed", 2, v * (1 - 2e-9), v * (1 - 1e-9), false, m));
      drawn = [...rows, ...more].sort((a, b) => a[0] - b[0]);
    }
  }
  return { rows, drawn };
}

/** Ranges of the axis in which a code holds: from the rows, as the command tells them. */
function ranges(rows, bit) {
  const out = [];
  rows.forEach((r, i) => {
    if (!(r[ROW.validity] & bit)) return;
    const from = i > 0 ? rows[i - 1][0] : r[0], to = i + 1 < rows.length ? rows[i + 1][0] : r[0];
    const last = out[out.length - 1];
    if (last && last[1] >= r[0]) last[1] = to;
    else out.push([(from + r[0]) / 2, to]);
  });
  return out;
}

const sized = (id) => {
  const node = document.getElementById(id);
  const width = Math.max(300, Math.min(760, node.clientWidth || 600));
  return { width, height: Math.round(Math.max(240, width * 0.52)) };
};

/** The band of a wall that scatters, its median and, beside restitution, the probability of sticking. */
function spreadIn({ s, spread }, sx, sy) {
  const column = 2 + 3 * Object.keys(QUANTITIES).indexOf(s.quantity);
  const at = (c) => Array.from({ length: spread.length / SPREAD.columns }, (_, i) => [spread[i * SPREAD.columns], spread[i * SPREAD.columns + c]]);
  const parts = [area(at(column + 1), at(column + 2), sx, sy, SPREAD.color, ' opacity="0.22"'), line(at(column), sx, sy, SPREAD.color, DASHES[1], 1.8)];
  if (s.quantity === "restitution") parts.push(line(at(1), sx, sy, SPREAD.stick, DASHES[2], 1.8));
  return parts;
}

/** Curve of the law, those kept, points, warnings in the picture. */
function drawCurves(shown) {
  const { s, m, own, kept, span: [from, to], figures } = shown;
  const value = (r) => r[ROW[s.quantity]];
  const all = [own, ...kept.flatMap((k) => [k.low, k.high].filter(Boolean))].flatMap((c) => c.rows.map(value));
  const most = Math.max(1, ...all.filter(Number.isFinite), ...s.points.map((p) => p[1]));
  const least = Math.min(0, ...all.filter(Number.isFinite));
  const x = axisOf(s.over, from, to);
  const y = { from: least, to: s.quantity === "impulse_ratio" ? Math.max(...all.filter(Number.isFinite), 0.05) * 1.08 : most, label: QUANTITIES[s.quantity] };
  const main = "var(--main)";
  const preset = PRESETS.find((p) => p.id === s.preset);
  const stated = preset && preset.over === s.over && preset.quantity === s.quantity ? preset.stated : [];
  const svg = frame({ ...sized("curves"), x, y, label: `${QUANTITIES[s.quantity]} over ${s.over}` }, (sx, sy, box) => {
    const parts = [], told = [];
    let row = 0;
    LISTS.validity.forEach((v) => {
      const found = ranges(own.rows, v.bit);
      found.forEach(([a, b]) => {
        const [ground, words] = shaded(a, b, v.code, sx, box, row, v.code === "above-yield" ? "mild" : "");
        parts.push(ground);
        told.push(words);
      });
      row += found.length ? 1 : 0;
    });
    kept.forEach((k, i) => {
      const color = COLORS[(i + 1) % COLORS.length];
      const points = (c) => c.drawn.map((r) => [r[0], value(r)]);
      if (k.high) parts.push(area(points(k.low), points(k.high), sx, sy, color, ' opacity="0.25"'));
      parts.push(line(points(k.low), sx, sy, color, k.dashed ? DASHES[1] : k.high ? "" : DASHES[(i + 1) % 4], 1.6));
      if (k.high) parts.push(line(points(k.high), sx, sy, color, "", 1.6));
    });
    if (shown.spread) parts.push(...spreadIn(shown, sx, sy));
    parts.push(line(own.drawn.map((r) => [r[0], value(r)]), sx, sy, main, "", 2.6));
    if (s.over === "speed") {
      const along = Math.sin((m.angle * Math.PI) / 180);
      parts.push(mark(figures.capture / along, "capture", sx, box, 1));
      if (figures.yield > 0) parts.push(mark(figures.yield / along, "yield", sx, box, 0));
    }
    const here = shown.here, one = shown.row[ROW[s.quantity]];
    if (here >= from && here <= to && Number.isFinite(one)) parts.push(`<circle cx="${sx(here).toFixed(1)}" cy="${sy(one).toFixed(1)}" r="5" fill="${main}" class="here"/>`);
    parts.push(limits(stated, sx, sy), dots(s.points, sx, sy, "var(--ink)"), ...told);
    return parts.join("");
  });
  put("curves", svg);
  const [first] = preset?.curves ?? [];
  const same = first && !first.to && JSON.stringify(first.law) === JSON.stringify(s.law) && first.diameter === s.motion.diameter;
  const entries = [{ label: same ? `this law: ${first.label}` : "this law", color: main }];
  if (shown.spread) {
    entries.push({ label: `the wall scatters: median of ${SPREAD.samples} spheres, and from 5 to 95 % of those that rebound or stay`, color: SPREAD.color, dash: DASHES[1] });
    if (s.quantity === "restitution") entries.push({ label: "probability of sticking", color: SPREAD.stick, dash: DASHES[2] });
  }
  kept.forEach((k, i) => entries.push({ label: k.label, color: COLORS[(i + 1) % COLORS.length], dash: k.dashed ? DASHES[1] : k.high ? "" : DASHES[(i + 1) % 4] }));
  if (stated.length) entries.push({ label: `limits that the source states: ${stated.map(([x, y, side]) => `${side} ${y} at ${x}`).join(", ")}`, kind: "limit" });
  if (s.points.length) entries.push({ label: shown.pointsFrom, color: "var(--ink)", kind: "dot" });
  document.getElementById("curves-legend").innerHTML = legend(entries);
}

/** Where the energy goes, stacked. */
function drawEnergy(shown) {
  const { s, own, span: [from, to] } = shown;
  const names = LISTS.energy, order = ["kept", ...names.filter((n) => n !== "kept")];
  const share = (r, name) => r[ROW.energy + names.indexOf(name)];
  const used = order.filter((n) => own.drawn.some((r) => share(r, n) > 1e-9));
  const svg = frame({ ...sized("energy"), x: axisOf(s.over, from, to), y: { from: 0, to: 1, label: "share of the kinetic energy" }, label: "Energy budget" }, (sx, sy) => {
    let below = own.drawn.map((r) => [r[0], 0]);
    return used.map((name) => {
      const above = own.drawn.map((r, i) => [r[0], below[i][1] + Math.max(0, share(r, name))]);
      const part = area(below, above, sx, sy, ENERGY[name], ` stroke="var(--ground)" stroke-width="0.8"`);
      below = above;
      return part;
    }).join("");
  });
  put("energy", svg);
  document.getElementById("energy-legend").innerHTML = legend(used.map((n) => ({ label: ENERGY_WORDS[n], color: ENERGY[n], kind: "area" })));
}

/** Stick, rebound, yield over speed and diameter; hatched where a code doubts the model. */
function drawMap(shown, columns, rows, speeds, diameters, cells) {
  const edges = (n, [a, b]) => Array.from({ length: n + 1 }, (_, i) => (i === 0 ? a : i === n ? b : a * (b / a) ** ((i - 0.5) / (n - 1))));
  const x = axisOf("speed", ...speeds), y = axisOf("diameter", ...diameters);
  let doubts = 0;
  const svg = frame({ ...sized("map"), x, y, label: "Map of fates over speed and diameter" }, (sx, sy, box) => {
    const [ex, ey] = [edges(columns, speeds), edges(rows, diameters)];
    const parts = [`<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><line x1="0" x2="0" y1="0" y2="6" stroke="#000" stroke-width="1.1" opacity="0.65"/></pattern></defs>`];
    const runs = (get, draw) => {
      for (let j = 0; j < rows; j += 1) {
        for (let i = 0; i < columns;) {
          let k = i;
          const what = get(j * columns + i);
          while (k < columns && get(j * columns + k) === what) k += 1;
          const rect = `x="${sx(ex[i]).toFixed(2)}" y="${sy(ey[j + 1]).toFixed(2)}" width="${(sx(ex[k]) - sx(ex[i]) + 0.3).toFixed(2)}" height="${(sy(ey[j]) - sy(ey[j + 1]) + 0.3).toFixed(2)}"`;
          parts.push(draw(what, rect));
          i = k;
        }
      }
    };
    runs((n) => cells[2 * n], (what, rect) => `<rect ${rect} fill="${REGIONS[what][1]}"/>`);
    runs((n) => (outside(cells[2 * n + 1]) ? 1 : 0), (what, rect) => { doubts |= what; return what ? `<rect ${rect} fill="url(#hatch)"/>` : ""; });
    const { speed, diameter } = shown.m;
    if (speed >= speeds[0] && speed <= speeds[1] && diameter >= diameters[0] && diameter <= diameters[1]) {
      parts.push(`<circle cx="${sx(speed).toFixed(1)}" cy="${sy(diameter).toFixed(1)}" r="6" fill="#fff" stroke="#000" stroke-width="2"/>`);
    }
    return `<g shape-rendering="crispEdges">${parts.join("")}</g>`;
  });
  put("map", svg);
  const there = new Set(cells.filter((_, i) => i % 2 === 0));
  const entries = REGIONS.filter((_, i) => there.has(i)).map(([label, color]) => ({ label, color, kind: "area" }));
  let bits = 0;
  for (let i = 1; i < cells.length; i += 2) bits |= outside(cells[i]);
  const codes = LISTS.validity.filter((v) => bits & v.bit).map((v) => v.code).join(", ");
  if (doubts) entries.push({ label: `outside validity (${codes})`, kind: "hatch" });
  document.getElementById("map-legend").innerHTML = legend(entries);
}

/** The sphere before and after, seen from the side. */
function drawRebound(shown) {
  const { m, row } = shown;
  const [w, h, ground] = [420, 230, 185];
  const rebounds = row[ROW.fate] === 1;
  const [n, t, spin] = [row[ROW.normal], row[ROW.tangential], row[ROW.spin]];
  const rad = (m.angle * Math.PI) / 180;
  const r = 26, cx = w / 2, cy = ground - r, reach = 130;
  const from = [cx - reach * Math.cos(rad), cy - reach * Math.sin(rad)];
  const size = reach / m.speed;
  const to = [cx + t * size, cy - n * size];
  const arrow = (a, b, color, id) => `<line x1="${a[0].toFixed(1)}" y1="${a[1].toFixed(1)}" x2="${b[0].toFixed(1)}" y2="${b[1].toFixed(1)}" stroke="${color}" stroke-width="3" marker-end="url(#${id})"/>`;
  const head = (id, color) => `<marker id="${id}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="5" markerHeight="5" orient="auto"><path d="M0 0 8 4 0 8z" fill="${color}"/></marker>`;
  const turn = (x, y, omega, color, id) => {
    if (omega === 0) return "";
    const f = omega > 0 ? 1 : 0; // forward along +x is clockwise as drawn
    const [a, b] = [x - 14, x + 14];
    return `<path d="M${f ? a : b} ${y + 4} A15 15 0 1 ${f} ${f ? b : a} ${y + 4}" fill="none" stroke="${color}" stroke-width="2" marker-end="url(#${id})"/>`;
  };
  const angle = Math.abs(row[ROW.angle]);
  const words = rebounds ? `leaves at ${short(Math.hypot(n, t))} m/s, ${short(angle)}° from the surface, spin ${short(spin)} rad/s` : "captured: it stays on the wall";
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${w} ${h}" role="img" aria-label="Rebound: ${escapeXml(words)}" font-family="system-ui, sans-serif" font-size="12">
<defs>${head("in", "#0072B2")}${head("out", "#D55E00")}<pattern id="wall" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><line x1="0" x2="0" y1="0" y2="8" class="wall-line"/></pattern></defs>
<rect x="0" y="${ground}" width="${w}" height="14" fill="url(#wall)"/><line x1="0" x2="${w}" y1="${ground}" y2="${ground}" class="axis"/>
<circle cx="${from[0].toFixed(1)}" cy="${from[1].toFixed(1)}" r="${r}" class="ball" stroke-dasharray="4 3"/><circle cx="${cx}" cy="${cy}" r="${r}" class="ball"/>
${turn(from[0], from[1], m.spin, "#0072B2", "in")}${arrow(from, [cx, cy], "#0072B2", "in")}
${rebounds ? arrow([cx, cy], to, "#D55E00", "out") + turn(cx, cy, spin, "#D55E00", "out") : ""}
<text x="10" y="18">in: ${short(m.speed)} m/s at ${short(m.angle)}°${m.spin ? `, spin ${short(m.spin)} rad/s` : ""}</text>
<text x="${w - 10}" y="${h - 10}" text-anchor="end">${escapeXml(words)}</text></svg>`;
  put("rebound", svg);
  const [e, et] = [row[ROW.restitution], row[ROW.tangential_restitution]];
  document.getElementById("rebound-legend").innerHTML = `<li>e = ${short(e)}</li><li>eₜ = ${short(et)}</li><li>μ = ${short(row[ROW.impulse_ratio])}</li><li>contact: ${["none", "sliding", "rolling", "micro-slip"][row[ROW.contact]]}</li>`;
}

/** Force over time, and the overlap. */
function drawHistory(moments) {
  const n = moments.length / 6, of = (k) => Array.from({ length: n }, (_, i) => moments[6 * i + k]);
  const [time, overlap, , hertz, net] = [0, 1, 2, 3, 4].map(of);
  const unit = (values, name) => {
    const most = Math.max(...values.map(Math.abs));
    const [f, p] = [[1, ""], [1e3, "m"], [1e6, "µ"], [1e9, "n"], [1e12, "p"], [1e15, "f"]].find(([k]) => most * k >= 1) ?? [1, ""];
    return { factor: f, text: `${p}${name}` };
  };
  const [ut, uf, ux] = [unit(time, "s"), unit(hertz, "N"), unit(overlap, "m")];
  const most = Math.max(...hertz, ...net), least = Math.min(0, ...net);
  const x = { from: 0, to: time[n - 1], factor: ut.factor, label: `time, ${ut.text}` };
  const y = { from: least * 1.05, to: most * 1.05, factor: uf.factor, label: `force away from the wall, ${uf.text}` };
  const deepest = Math.max(...overlap);
  put("history", frame({ ...sized("history"), x, y, label: "The contact in time" }, (sx, sy) =>
    line(time.map((t, i) => [t, (overlap[i] / deepest) * most]), sx, sy, "var(--faint)", DASHES[2], 2)
    + line(time.map((t, i) => [t, hertz[i]]), sx, sy, COLORS[4], DASHES[1])
    + line(time.map((t, i) => [t, net[i]]), sx, sy, "var(--main)", "", 2.6)));
  document.getElementById("history-legend").innerHTML = legend([
    { label: "net force", color: "var(--main)" }, { label: "Hertz force", color: COLORS[4], dash: DASHES[1] },
    { label: `overlap, greatest ${short(deepest * ux.factor)} ${ux.text}`, color: "var(--faint)", dash: DASHES[2] }]);
}
