// The kernel's bytes: base64 of gzip. Where the browser cannot unpack gzip, a small inflate does (RFC 1951).
"use strict";

function fromBase64(text) {
  const raw = atob(text.replace(/\s/g, ""));
  return Uint8Array.from(raw, (c) => c.charCodeAt(0));
}

async function gunzip(bytes) {
  if (typeof DecompressionStream === "function") {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }
  return inflate(bytes);
}

/** gzip without a name or a comment, as the page's build writes it. */
function inflate(bytes) {
  let at = 10, bit = 0;
  const size = new DataView(bytes.buffer, bytes.byteOffset + bytes.length - 4).getUint32(0, true);
  const out = new Uint8Array(size);
  let end = 0;
  const bits = (n) => {
    let value = 0;
    for (let i = 0; i < n; i += 1) {
      value |= ((bytes[at] >> bit) & 1) << i;
      bit += 1;
      if (bit === 8) { bit = 0; at += 1; }
    }
    return value;
  };
  const tree = (lengths) => {
    const count = new Uint16Array(16), next = new Uint16Array(17), symbols = new Uint16Array(lengths.length);
    lengths.forEach((l) => { count[l] += 1; });
    count[0] = 0;
    for (let l = 1; l < 16; l += 1) next[l + 1] = next[l] + count[l];
    lengths.forEach((l, symbol) => { if (l) { symbols[next[l]] = symbol; next[l] += 1; } });
    return { count, symbols };
  };
  const symbol = ({ count, symbols }) => {
    let code = 0, first = 0, index = 0;
    for (let l = 1; l < 16; l += 1) {
      code |= bits(1);
      if (code - count[l] < first) return symbols[index + code - first];
      index += count[l];
      first = (first + count[l]) << 1;
      code <<= 1;
    }
    throw new Error("the page's bytes are damaged");
  };
  const base = (extra, from) => { let b = from; return extra.map((e) => { const now = b; b += 1 << e; return now; }); };
  const lengthExtra = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0];
  const lengthBase = base(lengthExtra, 3);
  lengthBase[28] = 258;
  const backExtra = Array.from({ length: 30 }, (_, i) => Math.max(0, (i >> 1) - 1));
  const backBase = base(backExtra, 1);
  for (let last = 0; !last;) {
    last = bits(1);
    const kind = bits(2);
    if (kind === 0) {
      if (bit) { bit = 0; at += 1; }
      const n = bytes[at] | (bytes[at + 1] << 8);
      out.set(bytes.subarray(at + 4, at + 4 + n), end);
      at += 4 + n;
      end += n;
      continue;
    }
    let literals, backs;
    if (kind === 1) {
      literals = tree(Array.from({ length: 288 }, (_, i) => (i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8)));
      backs = tree(new Array(30).fill(5));
    } else {
      const [n, m, k] = [bits(5) + 257, bits(5) + 1, bits(4) + 4];
      const lengths = new Array(19).fill(0);
      [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15].slice(0, k).forEach((i) => { lengths[i] = bits(3); });
      const codes = tree(lengths), all = [];
      while (all.length < n + m) {
        const s = symbol(codes);
        if (s < 16) all.push(s);
        else {
          const [value, times] = s === 16 ? [all[all.length - 1], 3 + bits(2)] : [0, s === 17 ? 3 + bits(3) : 11 + bits(7)];
          for (let i = 0; i < times; i += 1) all.push(value);
        }
      }
      literals = tree(all.slice(0, n));
      backs = tree(all.slice(n));
    }
    for (let s = symbol(literals); s !== 256; s = symbol(literals)) {
      if (s < 256) { out[end] = s; end += 1; continue; }
      const length = lengthBase[s - 257] + bits(lengthExtra[s - 257]);
      const b = symbol(backs), back = backBase[b] + bits(backExtra[b]);
      for (let i = 0; i < length; i += 1, end += 1) out[end] = out[end - back];
    }
  }
  return out;
}
