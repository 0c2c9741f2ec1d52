// "Copy as": the command, a law file, Python, C.
"use strict";

const flag = (key) => `--${key === "normal" ? "law" : key.replaceAll("_", "-")}`;
const shell = (text) => (/^[\w.,:=\/+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

function lawFlags(law) {
  return Object.entries(law).map(([key, value]) => `${flag(key)} ${shell(key === "normal" ? asList(value).join(",") : value.trim())}`);
}

/** A bare number before one with a unit would take that unit, so both ends carry theirs. */
const withUnit = (over, text) => text.trim().replace(/ /g, "") + (isNumber(text) ? { speed: "m/s", diameter: "m" }[over] ?? "" : "");

/** The impact and the sweep that the page shows. */
function commands(law, s) {
  const m = s.motion;
  const spin = m.spin.trim() && Number(m.spin) !== 0 ? [`--spin ${shell(m.spin.trim())}`] : [];
  const head = (skip) => ["diameter", "speed", "angle"].filter((k) => k !== skip).map((k) => `--${k} ${shell(m[k].trim())}`).concat(spin);
  const flags = lawFlags(law), along = lawFlags(Object.fromEntries(Object.entries(law).filter(([k]) => k !== s.over)));
  const lines = (words, parts) => [words, ...parts].join(" \\\n  ");
  const over = `--over ${s.over.replaceAll("_", "-")}=${withUnit(s.over, s.range[0])}..${withUnit(s.over, s.range[1])}`;
  return {
    impact: lines("carom impact", [...flags, ...head()]),
    sweep: lines("carom sweep", [...along, ...head(s.over), over, `--quantity ${s.quantity.replaceAll("_", "-")} --plot curve.svg --out curve.csv`]),
  };
}

function python(law, s) {
  const value = (key, v) => (key === "normal" ? tomlValue(key, v) : isNumber(v) ? v.trim() : JSON.stringify(v.trim()));
  const args = Object.entries(law).map(([k, v]) => `    ${k}=${value(k, v)},\n`).join("");
  const q = (v) => (isNumber(v) ? v.trim() : JSON.stringify(v.trim()));
  const m = s.motion;
  const spin = m.spin.trim() && Number(m.spin) !== 0 ? `, spin=${q(m.spin)}` : "";
  return `import carom\n\nlaw = carom.WallLaw(\n${args})\nout = law.impact(diameter=${q(m.diameter)}, speed=${q(m.speed)}, angle=${q(m.angle)}${spin})\nprint(out)\n`;
}

function cProgram(law, m) {
  const text = `[law.wall]\n${toml(law)}`.split("\n").filter(Boolean).map((l) => `    ${JSON.stringify(`${l}\n`)}`).join("\n");
  const [n, t] = KERNEL.components(m);
  return `/* cc impact.c $(pkg-config --cflags --libs carom) -o impact */
#include <carom.h>

#include <stdio.h>
#include <stdlib.h>

static const char walls[] =
${text};

static void check(carom_status status)
{
    if (status != CAROM_STATUS_OK) {
        fprintf(stderr, "%s\\n", carom_last_error());
        exit(EXIT_FAILURE);
    }
}

int main(void)
{
    carom_law *wall = NULL;
    carom_impact_in in = {0};
    carom_impact_out out = {0};

    check(carom_law_from_text(walls, "wall", NULL, &wall));
    in.size = sizeof in;
    out.size = sizeof out;
    in.diameter = ${m.diameter};
    in.velocity[0] = ${t};
    in.velocity[1] = ${-n};
    in.spin[2] = ${m.spin === 0 ? "0.0" : -m.spin};
    in.normal[1] = 1.0;
    check(carom_impact(wall, &in, &out));
    printf("%s: e = %.17g\\n", carom_fate_name(out.fate), out.restitution);
    carom_law_free(wall);
    return 0;
}
`;
}

function copyText(kind, law, s) {
  if (kind === "toml") return `[law.wall]\n${toml(law)}`;
  if (kind === "python") return python(law, s);
  if (kind === "c") return cProgram(law, motion(s.motion));
  const { impact, sweep } = commands(law, s);
  return `${impact}\n\n${sweep}\n`;
}
