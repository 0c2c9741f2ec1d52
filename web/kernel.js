// The kernel: WebAssembly out of the page's own bytes, its buffers, its calls. The same text runs in the worker.
"use strict";

const COLUMNS = 19;
const ROW = { at: 0, fate: 1, restitution: 2, normal: 3, tangential: 4, spin: 5, angle: 6, impulse_ratio: 7, tangential_restitution: 8, contact: 9, energy: 10, validity: 18 };

/** What the kernel refuses, in its own words. */
class Refused extends Error {}

class Kernel {
  constructor(instance) {
    this.w = instance.exports;
  }

  static async from(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Kernel(instance);
  }

  give(text) {
    const bytes = new TextEncoder().encode(text);
    const at = this.w.text_in(bytes.length); // may move the memory
    new Uint8Array(this.w.memory.buffer, at, bytes.length).set(bytes);
  }

  said() {
    return new TextDecoder().decode(new Uint8Array(this.w.memory.buffer, this.w.text_at(), this.w.text_length()));
  }

  numbers(done) {
    if (!done) throw new Refused(this.said());
    return new Float64Array(this.w.memory.buffer, this.w.numbers_at(), this.w.numbers_length()).slice();
  }

  lists() {
    this.w.lists();
    return JSON.parse(this.said());
  }

  /** The keys that a law of this text reads. */
  reads(text) {
    this.give(text);
    if (!this.w.keys_read()) throw new Refused(this.said());
    return new Set(JSON.parse(this.said()));
  }

  /** A value of the motion as written, or of a law's key. */
  quantity(kind, text) {
    const place = ["diameter", "speed", "angle", "spin"].indexOf(kind);
    const number = place < 0 ? 4 + this.key(kind) : place; // before the text is given: the list of keys is a text too
    this.give(place < 0 ? `${kind} = ${tomlValue(kind, text)}\n` : text);
    return this.numbers(this.w.quantity(number))[0];
  }

  key(name) {
    this.keys ??= this.lists().keys.map((k) => k.name);
    return this.keys.indexOf(name);
  }

  /** The number of what runs. */
  runs(over) {
    const place = ["speed", "diameter", "angle"].indexOf(over);
    return place < 0 ? 3 + this.key(over) : place;
  }

  /** Normal and tangential speed. */
  components(m) {
    return this.numbers(this.w.components(m.speed, m.angle));
  }

  law(slot, text, oblique) {
    this.give(text);
    if (!this.w.law(slot, oblique ? 1 : 0)) throw new Refused(this.said());
  }

  /** Rows along what runs; `m` is the motion in numbers. */
  sweep(slot, over, count, from, to, linear, m) {
    const flat = this.numbers(this.w.sweep(slot, this.runs(over), count, from, to, linear ? 1 : 0, m.diameter, m.speed, m.angle, m.spin));
    return Array.from({ length: flat.length / COLUMNS }, (_, i) => flat.subarray(i * COLUMNS, (i + 1) * COLUMNS));
  }

  scatters(slot) {
    return this.w.scatters(slot) === 1;
  }

  /** Rows of 11 numbers: value, probability of sticking, median, 5 % and 95 % of the three quantities. */
  spread(slot, over, count, from, to, linear, m, samples) {
    return this.numbers(this.w.spread(slot, this.runs(over), count, from, to, linear ? 1 : 0, m.diameter, m.speed, m.angle, m.spin, samples));
  }

  figures(slot, m) {
    const n = this.numbers(this.w.figures(slot, m.diameter, m.speed, m.angle, m.spin));
    const names = ["capture", "exhausted", "yield", "material_yield", "critical_angle", "roughness_factor", "tabor", "adhesion_parameter", "stiffness", "work_of_adhesion", "plastic_constant", "density"];
    return { ...Object.fromEntries(names.map((name, i) => [name, n[i]])), warnings: JSON.parse(this.said()) };
  }

  map(slot, columns, rows, speeds, diameters, m) {
    return this.numbers(this.w.map(slot, columns, rows, ...speeds, ...diameters, m.angle, m.spin));
  }

  history(slot, m) {
    return this.numbers(this.w.history(slot, m.diameter, m.speed, m.angle, m.spin));
  }
}

/** One of the slow answers, by name: what the worker does, or the page itself where there is no worker. */
function slowly(kernel, job) {
  try {
    kernel.law(15, job.law, job.oblique);
    if (job.what === "map") return { cells: kernel.map(15, job.columns, job.rows, job.speeds, job.diameters, job.m) };
    if (job.what === "spread") return { spread: kernel.spread(15, job.over, job.count, ...job.span, job.linear, job.m, job.samples) };
    return { moments: kernel.history(15, job.m) };
  } catch (e) {
    if (!(e instanceof Refused)) throw e;
    return { refused: e.message };
  }
}

/** In the worker: the bytes come first, then jobs. */
function workerMain() {
  let kernel = null;
  onmessage = async ({ data }) => {
    if (data.bytes) kernel = Kernel.from(data.bytes);
    else postMessage({ id: data.id, ...slowly(await kernel, data.job) });
  };
}
