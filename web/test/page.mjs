// The explorer in Chromium against the command. node page.mjs PAGE.html CAROM LIBCAROM_C.a CAROM.H PYTHON PICTURES
import { execFileSync } from "node:child_process";
import { appendFileSync, mkdirSync, readFileSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "./chromium.mjs";

const [file, carom, library, header, python, pictures] = process.argv.slice(2).map((p) => resolve(p));
const url = pathToFileURL(file).href;
mkdirSync(pictures, { recursive: true });
const work = mkdtempSync(join(tmpdir(), "explorer-test-"));
let failures = 0, numbers = 0;
const check = (fine, what) => { if (!fine) { failures += 1; console.error(`FAILED: ${what}`); } };

/** A CSV file of the command or of the page, as lists of cells. */
function table(text) {
  const cells = (line) => {
    const out = [];
    line.replace(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g, (all, cell, at) => {
      if (at < line.length || line.endsWith(",")) out.push(cell.replace(/^"|"$/g, "").replaceAll('""', '"'));
      return "";
    });
    return out;
  };
  return text.trimEnd().split("\n").filter((l) => !l.startsWith("#")).map(cells);
}

/** Digit for digit. */
function same(a, b) {
  numbers += 1;
  if (a === b) return true;
  const [x, y] = [Number(a), Number(b)];
  if (a === "" || b === "") return (a === "" || a === "NaN") && (b === "" || b === "NaN");
  if (Number.isNaN(x) || Number.isNaN(y)) return a.toLowerCase() === b.toLowerCase();
  return x === y;
}

function compare(what, mine, theirs) {
  check(mine.length === theirs.length && mine.length > 50, `${what}: ${mine.length} rows against ${theirs.length}`);
  const [head, ...rows] = theirs;
  // the command writes diameters in the unit that they were given in
  const known = (h) => h.replace(/^diameter \(.*\)$/, "diameter");
  const at = mine[0].map((n) => head.findIndex((h) => known(h) === known(n)));
  check(at.every((i) => i >= 0), `${what}: columns ${mine[0]} against ${head}`);
  let wrong = 0;
  rows.forEach((row, i) => mine[0].forEach((name, k) => {
    if (!same(mine[i + 1][k], row[at[k]]) && (wrong += 1) === 1) check(false, `${what}: row ${i}, ${name}: ${mine[i + 1][k]}, the command ${row[at[k]]}`);
  }));
}

/** Runs what the page would have copied, each line of the command by a shell. */
function run(text) {
  return execFileSync("sh", ["-c", text.replace(/^carom/gm, `'${carom}'`)], { cwd: work, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
}

const browser = await chromium();
try {
  const page = await browser.open(url);
  await page.until("document.body.dataset.drawn");
  const ready = Number(await page.eval("document.body.dataset.ready"));
  const paint = await page.eval("Math.round(performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? NaN)");
  console.log(`first picture after ${ready} ms (first paint ${paint} ms); worker: ${await page.eval("WORKER !== null")}`);
  check(await page.eval("WORKER !== null"), "the worker did not start from a file");

  const settle = async () => {
    await page.until("!pending && document.body.dataset.drawn === String(turn)");
  };
  const presets = await page.eval("PRESETS.map((p) => [p.id, p.curves.length, p.points.length])");
  let curves = 0;
  for (const [id, count, points] of presets) {
    await page.eval(`usePreset(${JSON.stringify(id)}), redraw()`);
    await settle();
    check(await page.eval("document.getElementById('problem').hidden"), `${id}: ${await page.eval("document.getElementById('problem').textContent")}`);
    check(await page.eval("document.querySelectorAll('#curves circle.dot').length") === points, `${id}: points in the picture`);
    // the law itself, by what the page offers to copy
    run(await page.eval("commands(SHOWN.law, state).sweep"));
    const strip = (rows) => rows.filter((r, i) => i === 0 || r[0] === "this law").map((r) => r.slice(1));
    const shown = table(await page.eval("csvOf('curves')"));
    compare(id, strip(shown), table(readFileSync(join(work, "curve.csv"), "utf8")));
    curves += 1;
    // and each curve beside it
    const kept = await page.eval("state.kept.flatMap((k) => [[k.label, k.law, k.diameter], ...(k.to ? [[`${k.label} (upper)`, k.to, k.diameter]] : [])])");
    check(kept.length >= count - 1, `${id}: ${kept.length} curves kept of ${count}`);
    for (const [name, law, diameter] of kept) {
      run(await page.eval(`commands(${JSON.stringify(law)}, { ...state, motion: { ...state.motion, diameter: ${JSON.stringify(diameter)} } }).sweep`));
      const rows = shown.filter((r, i) => i === 0 || r[0] === name).map((r) => r.slice(1));
      compare(`${id}, ${name}`, rows, table(readFileSync(join(work, "curve.csv"), "utf8")));
      curves += 1;
    }
    // one impact, as JSON
    const told = JSON.parse(run(`${await page.eval("commands(SHOWN.law, state).impact")} --json`));
    const [row, figures] = await page.eval("[Array.from(SHOWN.row), SHOWN.figures]");
    const pairs = [["restitution", row[2], told.restitution], ["normal", row[3], told.rebound.normal], ["tangential", row[4], told.rebound.tangential], ["spin", row[5], told.rebound.spin], ["capture", figures.capture, told.capture_velocity], ["yield", figures.yield, told.yield_velocity], ["kept", row[17], told.energy.kept]];
    pairs.forEach(([n, a, b]) => { numbers += 1; check(a === (b ?? a) && (b !== null || a === null || Number.isNaN(a)), `${id}: ${n} ${a}, the command ${b}`); });
    check(JSON.stringify(figures.warnings.map((w) => w.code)) === JSON.stringify(told.validity), `${id}: warnings ${JSON.stringify(told.validity)}`);
    // the address brings it back
    const [hash, before] = await page.eval("[location.hash, JSON.stringify(state) + csvOf('curves')]");
    const again = await browser.open(url + hash);
    await again.until("document.body.dataset.drawn");
    check(await again.eval("JSON.stringify(state) + csvOf('curves')") === before, `${id}: the address does not bring it back`);
    check(again.complaints.length === 0, `${id}: ${again.complaints.join("; ")}`);
    await again.close();
  }

  // a law by hand: each way to copy it says the same
  const hash = "#sphere=rho%3D2500%2CE%3D70GPa%2Cnu%3D0.22%2Cgamma%3D0.1%2Csigma%3D1GPa&surface=copper&normal=resolved&friction=0.25&hertz_damping=0.002&diameter=40um&speed=3m/s&angle=35&spin=2000&over=angle&range=5..90&quantity=impulse_ratio";
  await page.eval(`location.hash = ${JSON.stringify(hash)}`);
  await page.until("state.law.normal === 'resolved' && SHOWN.law.normal === 'resolved'");
  await settle();
  const told = JSON.parse(run(`${await page.eval("commands(SHOWN.law, state).impact")} --json --history history.csv`));
  check(told.restitution === await page.eval("SHOWN.row[2]") && told.fate === "rebound", "the copied impact");
  writeFileSync(join(work, "walls.toml"), await page.eval("copyText('toml', SHOWN.law, state)"));
  const byFile = JSON.parse(run("carom impact --wall-law walls.toml:wall --diameter 40um --speed 3m/s --angle 35 --spin 2000 --json"));
  check(JSON.stringify(byFile.rebound) === JSON.stringify(told.rebound), "the copied law file");
  const history = table(readFileSync(join(work, "history.csv"), "utf8")).slice(1).flat().map(Number);
  const moments = await page.eval("ask({ what: 'history', law: toml(SHOWN.law), oblique: true, m: SHOWN.m }).then((a) => Array.from(a.moments))");
  check(history.length === moments.length && history.length > 3600 && history.every((v, i) => v === moments[i]), "the contact in time, in the worker");
  numbers += history.length;
  check(await page.eval("!document.getElementById('history-figure').hidden && document.querySelector('#history svg') !== null"), "the contact's picture");
  // by the module itself only where it is installed; its keywords are the law file's keys
  writeFileSync(join(work, "impact.py"), await page.eval("copyText('python', SHOWN.law, state)"));
  execFileSync("python3", ["-c", "import ast, sys; call = ast.parse(open(sys.argv[1]).read()).body[1].value; sys.exit([k.arg for k in call.keywords] != sys.argv[2:])", join(work, "impact.py"), ...await page.eval("Object.keys(SHOWN.law)")]);
  appendFileSync(join(work, "impact.py"), "print(repr(out.restitution))\n");
  const byPython = execFileSync(python, ["impact.py"], { cwd: work, encoding: "utf8" }).trimEnd().split("\n").at(-1);
  check(Number(byPython) === told.restitution, `the copied Python: ${byPython}, the command ${told.restitution}`);
  writeFileSync(join(work, "impact.c"), await page.eval("copyText('c', SHOWN.law, state)"));
  execFileSync("cc", ["-Wall", "-Werror", `-I${dirname(header)}`, "impact.c", library, "-lm", "-lpthread", "-ldl", "-o", "impact"], { cwd: work });
  const byC = execFileSync(join(work, "impact"), { encoding: "utf8" });
  check(Number(byC.split("e = ")[1]) === told.restitution, `the copied C program: ${byC}`);

  // a number of the law along the axis, in equal ratios and from 0 in equal steps
  const by = "#sphere=copper&surface=silicon&friction=0.2&diameter=30um&speed=2m/s&angle=60&spin=0&quantity=restitution";
  for (const [over, from, to, law] of [["roughness_factor", "0.05", "1", "normal=ea&roughness_factor=0.5"], ["hertz_damping", "0", "0.01", "normal=ea"], ["friction", "0", "1", "normal=ea"]]) {
    await page.eval(`location.hash = ${JSON.stringify(`${by}&${law}&over=${over}&range=${from}..${to}`)}`);
    await page.until(`SHOWN.s.over === '${over}' && document.getElementById('over').value === '${over}'`);
    await settle();
    check(await page.eval("document.getElementById('problem').hidden"), `${over}: ${await page.eval("document.getElementById('problem').textContent")}`);
    run(await page.eval("commands(SHOWN.law, state).sweep"));
    compare(over, table(await page.eval("csvOf('curves')")).map((r) => r.slice(1)), table(readFileSync(join(work, "curve.csv"), "utf8")));
    curves += 1;
  }

  // a wall that scatters
  await page.eval(`location.hash = ${JSON.stringify(`${by}&normal=ea&roughness_angle=5 deg&over=speed&range=0.1..30`)}`);
  await page.until("SHOWN.s.law.roughness_angle && SHOWN.spread");
  await settle();
  run(`${(await page.eval("commands(SHOWN.law, state).sweep")).replace("curve.csv", "spread.csv")} --samples 400 --points 60`);
  compare("the spread", table(await page.eval("spreadCsv()")), table(readFileSync(join(work, "spread.csv"), "utf8")));
  check(await page.eval("document.getElementById('curves-legend').textContent.includes('probability of sticking')"), "the spread's legend");

  // the map, cell by cell
  await page.eval("location.hash = '#sphere=copper&surface=silicon&normal=eap&friction=0.2&diameter=30um&speed=2m/s&angle=60&spin=0&over=speed&range=0.1..30&quantity=restitution'");
  await page.until("SHOWN.law.normal === 'eap' && SHOWN.law.surface === 'silicon'");
  await settle();
  const cells = await page.eval("ask({ what: 'map', law: toml(SHOWN.law), oblique: true, columns: 30, rows: 20, speeds: [0.1, 30], diameters: [1e-6, 1e-3], m: SHOWN.m }).then((a) => Array.from(a.cells))");
  run("carom sweep --sphere copper --surface silicon --law eap --friction 0.2 --angle 60 --over speed=0.1..30 --over diameter=1e-6..1e-3 --points 30 --out map.csv");
  run("carom sweep --sphere copper --surface silicon --law eap --friction 0.2 --angle 60 --over speed=0.1..30 --over diameter=1e-6..1e-3 --points 20 --out map20.csv");
  const native = table(readFileSync(join(work, "map20.csv"), "utf8"));
  const square = await page.eval("ask({ what: 'map', law: toml(SHOWN.law), oblique: true, columns: 20, rows: 20, speeds: [0.1, 30], diameters: [1e-6, 1e-3], m: SHOWN.m }).then((a) => Array.from(a.cells))");
  const fateAt = native[0].indexOf("fate");
  check(cells.length === 1200 && square.length === 800 && native.length === 401, "the map's size");
  check(native.slice(1).every((r, i) => (r[fateAt] === "capture") === (square[2 * i] === 0)), "the map's fates");
  numbers += 400;

  // mistakes are told and leave the picture
  await page.eval("(() => { const n = document.getElementById('law-sphere'); n.value = 'coper'; n.dispatchEvent(new Event('input')); })()");
  await page.until("!document.getElementById('problem').hidden");
  check((await page.eval("document.getElementById('problem').textContent")).includes("did you mean copper"), "a misspelt material");
  await page.eval("(() => { const n = document.getElementById('law-sphere'); n.value = 'copper'; n.dispatchEvent(new Event('input')); const d = document.getElementById('motion-diameter'); d.value = '70 kg'; d.dispatchEvent(new Event('input')); })()");
  await page.until("document.getElementById('motion-diameter-error').textContent.length > 5");
  await page.eval("(() => { const d = document.getElementById('motion-diameter'); d.value = '70 um'; d.dispatchEvent(new Event('input')); })()");
  await page.until("document.getElementById('problem').hidden");

  // own points, a slider by the keyboard, a kept curve, saved pictures
  await page.eval("takePoints('# made up\\nspeed,restitution,sigma\\n1,0.5,0.05\\n2,0.6,\\n')");
  await settle();
  check(await page.eval("document.querySelectorAll('#curves circle.dot').length") === 2, "own points");
  await page.eval("takePoints('speed (cm/s),restitution\\n150,0.5\\n')");
  check(await page.eval("state.points[0][0]") === 1.5, "own points in a unit of their own");
  await page.eval("takePoints('speed (kg),restitution\\n150,0.5\\n')");
  check((await page.eval("document.getElementById('problem').textContent")).includes("speed (kg)"), "points in a unit that is none");
  await page.eval("takePoints('speed,angle\\n1,2\\n')");
  check((await page.eval("document.getElementById('problem').textContent")).includes("restitution"), "points without a column");
  await page.eval("document.querySelector('[data-slides=\"motion-speed\"]').focus()");
  const speed = await page.eval("state.motion.speed");
  for (const type of ["rawKeyDown", "keyUp"]) await page.call("Input.dispatchKeyEvent", { type, key: "ArrowRight", code: "ArrowRight", windowsVirtualKeyCode: 39 });
  await page.until(`state.motion.speed !== ${JSON.stringify(speed)}`);
  await page.eval("document.getElementById('keep').click()");
  await page.until("SHOWN.kept.length === 1 && document.querySelectorAll('#curves-legend li').length === 3");
  for (const id of ["curves", "energy", "rebound", "map"]) {
    const svg = await page.eval(`standalone(${JSON.stringify(id)})`);
    check(svg.startsWith("<?xml") && !svg.includes("var(--"), `${id}: the saved picture`);
    const parsed = await page.eval(`new DOMParser().parseFromString(standalone(${JSON.stringify(id)}), 'image/svg+xml').querySelector('parsererror')?.textContent ?? ''`);
    check(parsed === "", `${id}: ${parsed}`);
  }
  check(await page.eval("[...document.querySelectorAll('input, select, button')].every((n) => n.labels?.length || n.getAttribute('aria-label') || n.textContent.trim())"), "an input without a name");

  // without a worker, and without the browser's own way to unpack
  const bare = await browser.open("about:blank");
  await bare.call("Page.addScriptToEvaluateOnNewDocument", { source: "delete globalThis.DecompressionStream; globalThis.Worker = class { constructor() { throw new Error('refused'); } };" });
  await bare.call("Page.navigate", { url: url + hash });
  await bare.until("document.body?.dataset.drawn");
  check(await bare.eval("WORKER === null && typeof DecompressionStream === 'undefined' && SHOWN.row[2]") === told.restitution, "without a worker and without DecompressionStream");
  check(bare.complaints.length === 0, `bare: ${bare.complaints.join("; ")}`);
  check(page.complaints.length === 0, page.complaints.join("; "));

  // pictures to look at
  const fig = `#${(await page.eval("(usePreset('dunn-1996.restitution'), toHash(state))")).slice(1)}`;
  const kharaz = `#${(await page.eval("(usePreset('kharaz-2001.tangential'), toHash(state))")).slice(1)}`;
  for (const [name, at, options] of [["desktop-light", fig, {}], ["desktop-dark", kharaz, { dark: true }], ["phone-light", kharaz, { width: 390, height: 844, mobile: true }], ["phone-dark", hash, { width: 390, height: 844, mobile: true, dark: true }], ["resolved-light", hash, {}]]) {
    const one = await browser.open(url + at, options);
    await one.until("document.body.dataset.drawn");
    check(await one.eval("document.documentElement.scrollWidth <= innerWidth"), `${name}: wider than the window`);
    check(one.complaints.length === 0, `${name}: ${one.complaints.join("; ")}`);
    await one.picture(join(pictures, `${name}.png`));
    await one.close();
  }
  console.log(`${presets.length} presets, ${curves} curves, ${numbers} numbers as the command's; ${failures} failures; pictures in ${pictures}`);
} finally {
  await browser.close();
  rmSync(work, { recursive: true, force: true });
}
process.exit(failures ? 1 : 0);
