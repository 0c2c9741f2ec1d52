// Every registered law: the WebAssembly gives the bits that the native library gave. node bits.mjs KERNEL.wasm BITS.txt
import { createReadStream } from "node:fs";
import { createInterface } from "node:readline";
import { kernel } from "./kernel.mjs";

const [wasm, file] = process.argv.slice(2);
const k = await kernel(wasm);
const w = k.exports;
const counts = { law: 0, impact: 0, sweep: 0, figures: 0, history: 0, refused: 0, numbers: 0 };
const bits = (text) => text.split(",").map((h) => BigInt("0x" + h));
const float = (b) => new Float64Array(new BigUint64Array([b]).buffer)[0];
let law = "", wrong = 0;

function run(what, input) {
  const n = input.map(float);
  switch (what) {
    case "impact": k.bits(input); return w.impact(0);
    case "sweep": return w.sweep(0, ...n);
    case "figures": return w.figures(0, ...n);
    case "history": return w.history(0, ...n);
    default: throw new Error(`unknown line ${what}`);
  }
}

// the sign and the payload of a NaN are the processor's own affair
const same = (a, b) => a === b || (Number.isNaN(float(a)) && Number.isNaN(float(b)));

for await (const line of createInterface({ input: createReadStream(file) })) {
  if (line.startsWith("law ")) {
    law = JSON.parse(line.slice(4));
    k.text(law);
    if (!w.law(0, 0)) throw new Error(`${law}: ${k.said()}`);
    counts.law += 1;
    continue;
  }
  const [what, input, output] = line.split(" ");
  const done = run(what, bits(input));
  counts[what] += 1;
  if (output === "-" || !done) {
    counts.refused += 1;
    if ((output === "-") === Boolean(done)) { wrong += 1; console.error(`${law}${line}: ${done ? "answered" : k.said()}`); }
    continue;
  }
  const want = bits(output), got = k.answer();
  counts.numbers += want.length;
  const off = want.findIndex((b, i) => got.length !== want.length || !same(b, got[i]));
  if (off >= 0 && (wrong += 1) < 10) console.error(`${law}${what}: number ${off}: ${float(got[off] ?? 0n)}, natively ${float(want[off])}`);
}
console.log(`bits: ${counts.law} laws, ${counts.impact} impacts, ${counts.sweep} sweeps, ${counts.figures} figures, ${counts.history} histories (${counts.refused} refused on both sides), ${counts.numbers} numbers; ${wrong} differ`);
if (counts.law < 223 || counts.history < 40 || wrong > 0) process.exit(1);
