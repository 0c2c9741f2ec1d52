// Plots as SVG texts: axes, lines, areas, cells, points. No physics.
"use strict";

// Okabe & Ito's palette, told apart with every common kind of colour vision; black and yellow are left out for dark and light grounds.
const COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
const DASHES = ["", "7 4", "2 3", "9 3 2 3"];

const escapeXml = (text) => String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/** A number to a few digits, as people write it. */
function short(v, digits = 4) {
  if (!Number.isFinite(v)) return "–";
  if (v === 0) return "0";
  const a = Math.abs(v);
  if (a >= 1e5 || a < 1e-3) {
    const [m, e] = v.toExponential(digits - 1).split("e");
    return `${Number(m)}×10${String(Number(e)).replace(/[-\d]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)])}`;
  }
  return String(Number(v.toPrecision(digits)));
}

/** With a prefix that suits it: 70 µm. */
function prefixed(v, unit) {
  if (!Number.isFinite(v)) return "–";
  if (v === 0) return `0 ${unit}`;
  const steps = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"], [1e-12, "p"], [1e-15, "f"]];
  const [factor, prefix] = steps.find(([f]) => Math.abs(v) >= f * 0.9999995) ?? steps[8];
  return `${short(v / factor)} ${prefix}${unit}`;
}

/** An axis: from, to, log, label, factor (shown = value × factor). */
function scale({ from, to, log }, a, b) {
  const f = log ? Math.log : (v) => v;
  const [low, high] = [f(from), f(to)];
  return (v) => a + ((f(v) - low) / (high - low)) * (b - a);
}

function ticks({ from, to, log, factor = 1 }, room) {
  const [low, high] = [from * factor, to * factor];
  if (!log) {
    const raw = (high - low) / room, size = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((n) => n * size).find((s) => s >= raw);
    const out = [];
    for (let i = Math.ceil(low / step - 1e-9); i <= high / step + 1e-9; i += 1) out.push({ v: (i * step) / factor, text: short(i * step) });
    return out;
  }
  const decades = Math.log10(high / low), out = [];
  const marks = decades > room ? [1] : decades > 1.5 ? [1] : [1, 2, 5];
  const skip = Math.ceil(decades / room);
  for (let d = Math.floor(Math.log10(low)); d <= Math.ceil(Math.log10(high)); d += 1) {
    for (let m = 1; m < 10; m += 1) {
      const shown = m * 10 ** d;
      if (shown < low * 0.999999 || shown > high * 1.000001) continue;
      out.push({ v: shown / factor, text: marks.includes(m) && d % skip === 0 ? short(shown) : "", minor: m !== 1 });
    }
  }
  return out;
}

/** The frame: axes, grid, labels; `inside(x, y, box)` gives what is drawn within it. */
function frame({ width, height, x, y, label, right = 12 }, inside) {
  const box = { left: 52, top: 10, right: width - right, bottom: height - 40 };
  const sx = scale(x, box.left, box.right), sy = scale(y, box.bottom, box.top);
  const parts = [];
  ticks(x, Math.max(3, (box.right - box.left) / 70)).forEach((t) => {
    const at = sx(t.v).toFixed(1);
    parts.push(`<line class="grid${t.minor ? " minor" : ""}" x1="${at}" x2="${at}" y1="${box.top}" y2="${box.bottom}"/>`);
    if (t.text) parts.push(`<text x="${at}" y="${box.bottom + 16}" text-anchor="middle">${t.text}</text>`);
  });
  ticks(y, Math.max(3, (box.bottom - box.top) / 45)).forEach((t) => {
    const at = sy(t.v).toFixed(1);
    parts.push(`<line class="grid${t.minor ? " minor" : ""}" x1="${box.left}" x2="${box.right}" y1="${at}" y2="${at}"/>`);
    if (t.text) parts.push(`<text x="${box.left - 6}" y="${+at + 4}" text-anchor="end">${t.text}</text>`);
  });
  const id = `clip-${label.replace(/\W+/g, "-")}`;
  const middle = (box.top + box.bottom) / 2;
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" role="img" aria-label="${escapeXml(label)}" font-family="system-ui, sans-serif" font-size="12">
<clipPath id="${id}"><rect x="${box.left}" y="${box.top}" width="${box.right - box.left}" height="${box.bottom - box.top}"/></clipPath>
${parts.join("")}<g clip-path="url(#${id})">${inside(sx, sy, box)}</g>
<rect class="box" x="${box.left}" y="${box.top}" width="${box.right - box.left}" height="${box.bottom - box.top}"/>
<text x="${(box.left + box.right) / 2}" y="${height - 6}" text-anchor="middle">${escapeXml(x.label)}</text>
<text x="13" y="${middle}" text-anchor="middle" transform="rotate(-90 13 ${middle})">${escapeXml(y.label)}</text></svg>`;
}

/** A polyline; numbers that are none break it. */
function path(points, sx, sy) {
  let pen = "M";
  return points.map(([x, y]) => {
    if (!Number.isFinite(y)) { pen = "M"; return ""; }
    const part = `${pen}${sx(x).toFixed(2)} ${sy(y).toFixed(2)}`;
    pen = "L";
    return part;
  }).join("");
}

const line = (points, sx, sy, color, dash = "", width = 2) => `<path d="${path(points, sx, sy)}" fill="none" stroke="${color}" stroke-width="${width}" stroke-linejoin="round"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`;

/** The area between two lines over the same x. */
function area(lower, upper, sx, sy, fill, more = "") {
  const both = [...upper, ...[...lower].reverse()];
  return `<path d="${path(both, sx, sy)}Z" fill="${fill}"${more}/>`;
}

/** A shaded range of x, and words along its top, which are drawn last. */
function shaded(from, to, text, sx, box, row, kind) {
  const [a, b] = [Math.max(box.left, sx(from)), Math.min(box.right, sx(to))];
  if (!(b - a > 0.5)) return ["", ""];
  const room = Math.floor((b - a) / 6.2), y = box.top + 4 + row * 17;
  const words = text.length <= room ? text : room > 6 ? `${text.slice(0, room - 1)}…` : "";
  return [
    `<rect class="shade ${kind}" x="${a.toFixed(1)}" y="${box.top}" width="${(b - a).toFixed(1)}" height="${box.bottom - box.top}"><title>${escapeXml(text)}</title></rect>`,
    `<line class="edge ${kind}" x1="${a.toFixed(1)}" x2="${b.toFixed(1)}" y1="${y}" y2="${y}"/><text class="shade-text" x="${(a + 3).toFixed(1)}" y="${y + 12}">${escapeXml(words)}</text>`,
  ];
}

/** A vertical mark with a word beside it. */
function mark(at, text, sx, box, low) {
  const x = sx(at);
  if (!(x > box.left && x < box.right)) return "";
  const left = x > (box.left + box.right) / 2;
  return `<line class="mark" x1="${x.toFixed(1)}" x2="${x.toFixed(1)}" y1="${box.top}" y2="${box.bottom}"/><text class="mark-text" x="${(x + (left ? -4 : 4)).toFixed(1)}" y="${box.bottom - 8 - low * 15}" text-anchor="${left ? "end" : "start"}">${escapeXml(text)}</text>`;
}

function dots(points, sx, sy, color) {
  return points.map(([x, y, sigma]) => {
    const [px, py] = [sx(x).toFixed(1), sy(y).toFixed(1)];
    const bar = sigma ? `<line x1="${px}" x2="${px}" y1="${sy(y - sigma).toFixed(1)}" y2="${sy(y + sigma).toFixed(1)}" stroke="${color}"/>` : "";
    return `${bar}<circle class="dot" cx="${px}" cy="${py}" r="4" stroke="${color}"/>`;
  }).join("");
}

/** Limits that a source states in words: the model is to lie where the arrow points. */
function limits(stated, sx, sy) {
  return stated.map(([x, y, side]) => {
    const [px, py, up] = [sx(x), sy(y), side === "above" ? -1 : 1];
    return `<path class="limit" d="M${px - 7} ${py}H${px + 7}M${px} ${py}v${11 * up}m-4 ${-5 * up}l4 ${5 * up}l4 ${-5 * up}"><title>stated: ${side} ${y} at ${x}</title></path>`;
  }).join("");
}

/** Colours, dashes and words beside a plot. */
function legend(entries) {
  return entries.map(({ label, color, dash, kind }) => {
    const swatch = kind === "area" ? `<rect x="1" y="2" width="22" height="10" fill="${color}" opacity="${dash ?? 1}"/>`
      : kind === "dot" ? `<circle cx="12" cy="7" r="4" fill="none" stroke="${color}" stroke-width="2"/>`
        : kind === "limit" ? `<path class="limit" d="M5 3H19M12 3v9m-4 -4l4 4l4 -4"/>`
        : kind === "hatch" ? `<rect x="1" y="2" width="22" height="10" fill="url(#hatch)" stroke="currentColor" stroke-width="0.5"/>`
          : `<line x1="1" x2="23" y1="7" y2="7" stroke="${color}" stroke-width="2.5"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`;
    return `<li><svg width="24" height="14" aria-hidden="true">${swatch}</svg>${escapeXml(label)}</li>`;
  }).join("");
}
