// Headless Chromium over its debugging pipe: as much of the protocol as the tests need.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--remote-debugging-pipe"];

export async function chromium() {
  const data = mkdtempSync(join(tmpdir(), "explorer-"));
  const browser = spawn("chromium", [...FLAGS, `--user-data-dir=${data}`, "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const [, , , write, read] = browser.stdio;
  let next = 0, text = "";
  const waiting = new Map(), listeners = [];
  read.on("data", (chunk) => {
    text += chunk;
    for (let end = text.indexOf("\0"); end >= 0; end = text.indexOf("\0")) {
      const message = JSON.parse(text.slice(0, end));
      text = text.slice(end + 1);
      if (message.id) {
        const [done, failed] = waiting.get(message.id);
        waiting.delete(message.id);
        if (message.error) failed(new Error(message.error.message));
        else done(message.result);
      } else listeners.forEach((l) => l(message));
    }
  });
  const send = (method, params = {}, sessionId = undefined) => new Promise((done, failed) => {
    next += 1;
    waiting.set(next, [done, failed]);
    write.write(`${JSON.stringify({ id: next, method, params, sessionId })}\0`);
  });

  async function open(url, { width = 1280, height = 900, dark = false, mobile = false } = {}) {
    const { targetId } = await send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
    const call = (method, params) => send(method, params, sessionId);
    const complaints = [];
    listeners.push((m) => {
      if (m.sessionId !== sessionId) return;
      if (m.method === "Runtime.exceptionThrown") complaints.push(m.params.exceptionDetails.exception?.description ?? m.params.exceptionDetails.text);
      if (m.method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(m.params.type)) complaints.push(m.params.args.map((a) => a.value ?? a.description).join(" "));
      if (m.method === "Log.entryAdded" && m.params.entry.level === "error") complaints.push(m.params.entry.text);
    });
    await Promise.all(["Runtime.enable", "Log.enable", "Page.enable"].map((m) => call(m)));
    await call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile });
    await call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    await call("Page.navigate", { url });
    const page = {
      call,
      complaints,
      async eval(expression) {
        const { result, exceptionDetails } = await call("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
      },
      /** Until an expression is true. */
      async until(expression, ms = 20000) {
        for (const start = Date.now(); Date.now() - start < ms;) {
          if (await page.eval(expression).catch(() => false)) return;
          await new Promise((done) => { setTimeout(done, 25); });
        }
        throw new Error(`never: ${expression}; ${complaints.join("; ")}`);
      },
      async picture(path, full = true) {
        const { cssContentSize: size } = await call("Page.getLayoutMetrics");
        const clip = { x: 0, y: 0, width: size.width, height: full ? size.height : height, scale: 1 };
        const { data: png } = await call("Page.captureScreenshot", { clip, captureBeyondViewport: true });
        writeFileSync(path, Buffer.from(png, "base64"));
      },
      close: () => send("Target.closeTarget", { targetId }),
    };
    return page;
  }

  const close = async () => {
    const gone = new Promise((done) => { browser.once("exit", done); });
    await send("Browser.close").catch(() => {});
    await gone;
    rmSync(data, { recursive: true, force: true, maxRetries: 5 });
  };
  return { open, close };
}
