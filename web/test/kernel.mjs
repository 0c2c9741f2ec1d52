// The WebAssembly for Node: calls with texts and numbers.
import { readFileSync } from "node:fs";

export async function kernel(path) {
  const { instance } = await WebAssembly.instantiate(readFileSync(path), {});
  const w = instance.exports;
  return {
    exports: w,
    text(text) {
      const bytes = new TextEncoder().encode(text);
      const at = w.text_in(bytes.length); // may move the memory
      new Uint8Array(w.memory.buffer, at, bytes.length).set(bytes);
    },
    said: () => new TextDecoder().decode(new Uint8Array(w.memory.buffer, w.text_at(), w.text_length())),
    /** Bits in, so that no NaN changes on its way. */
    bits(list) {
      const at = w.numbers_in(list.length);
      new BigUint64Array(w.memory.buffer, at, list.length).set(list);
    },
    answer: () => new BigUint64Array(w.memory.buffer, w.numbers_at(), w.numbers_length()).slice(),
  };
}
