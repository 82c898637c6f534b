// A phone's part: opens the page of a running show in Chromium, 390 x 844, presses what is on it, and keeps a
// picture. Prints one line of JSON.
// Usage: node remote_page.mjs CHROMIUM RAKS MUSIC.wav PICTURE.png     with a display
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import WebSocket from "ws";

const [chromium, raks, music, picture] = process.argv.slice(2);
const kPort = 17883;
const said = { faults: [] };
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const program = spawn(raks, ["play", "--no-sound", "--repeat", "--size", "320x240", music, "--remote",
  "--remote-address", `127.0.0.1:${kPort}`], { stdio: ["ignore", "ignore", "pipe"] });
let text = "";
program.stderr.on("data", (data) => { text += data; });
while (!text.includes("playing")) await sleep(10);

const folder = mkdtempSync(join(tmpdir(), "raks_chromium_"));
const browser = spawn(chromium, ["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0",
  `--user-data-dir=${folder}`, "about:blank"], { stdio: ["ignore", "ignore", "pipe"] });
let told = "";
browser.stderr.on("data", (data) => { told += data; });
while (!/listening on ws:\S+/.test(told)) await sleep(10);
const tools = told.match(/listening on ws:\/\/([^/]+)/)[1];
const pages = await (await fetch(`http://${tools}/json`)).json();
const socket = new WebSocket(pages.find((each) => each.type === "page").webSocketDebuggerUrl);
await once(socket, "open");
const waits = new Map();
let number = 0;
socket.on("message", (data) => {
  const message = JSON.parse(data);
  if (message.id) waits.get(message.id)(message.result);
  else if (message.method === "Runtime.exceptionThrown") said.faults.push(message.params.exceptionDetails.text);
  else if (message.method === "Network.requestWillBeSent") said.outside ||= !message.params.request.url.startsWith(
    `http://127.0.0.1:${kPort}/`) && !message.params.request.url.startsWith("data:");
});
const call = (method, params = {}) => new Promise((done) => {
  waits.set(++number, done);
  socket.send(JSON.stringify({ id: number, method, params }));
});
const value = async (expression) =>
  (await call("Runtime.evaluate", { expression, returnByValue: true })).result.value;
const until = async (expression) => { while (!(await value(expression))) await sleep(20); };
async function press(selector) {
  const at = JSON.parse(await value(`JSON.stringify((({ x, y, width, height }) =>
    ({ x: x + width / 2, y: y + height / 2 }))(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect()))`));
  await call("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [at] });
  await call("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}
for (const domain of ["Runtime", "Page", "Network"]) await call(`${domain}.enable`);
await call("Emulation.setDeviceMetricsOverride", { width: 390, height: 844, deviceScaleFactor: 2, mobile: true });
await call("Emulation.setTouchEmulationEnabled", { enabled: true });
await call("Page.navigate", { url: `http://127.0.0.1:${kPort}/` });
await until("typeof state === 'object' && state !== null && state.locked && offset !== null && lastBeat(there()) !== null");
said.size = await value("document.documentElement.scrollWidth + 'x' + document.documentElement.scrollHeight");
// The music has four beats a bar; until that is heard there may be another number.
await until("document.querySelectorAll('#dots i').length === 4");
writeFileSync(picture, Buffer.from((await call("Page.captureScreenshot", { format: "png" })).data, "base64"));
await press("#hold");
await until("state.held");
await press("[data-do='half-tempo']");
await press("[data-do='release-tempo']");
await until("!state.held");
await press("#keep");
await until("state.keeps_figure");
for (let i = 0; i < 3; ++i) await press("#tap");
await value("by('formation').value = 'couple'; by('formation').dispatchEvent(new Event('change'))");
await until("state.formation === 'couple'");
await value("by('camera').value = 'front'; by('camera').dispatchEvent(new Event('change'))");
await until("state.camera === 'front'");
// The whole surface flashes at most twice a second, and only where it is asked for.
said.flashesUnasked = await value("Number(by('flash').style.opacity)");
await value("window.flashes = []; by('whole').click(); let before = 0; " +
  "(function look() { if (lastFlash !== before) { before = lastFlash; flashes.push(before); } requestAnimationFrame(look); })()");
await sleep(4000);
const flashes = JSON.parse(await value("JSON.stringify(flashes)"));
said.flashes = flashes.length;
said.quickest = Math.min(...flashes.slice(2).map((at, i) => at - flashes[i + 1]));
browser.kill();
program.kill("SIGINT");
await Promise.all([once(browser, "exit"), once(program, "exit")]);
rmSync(folder, { recursive: true, force: true });
console.log(JSON.stringify(said));
process.exit(0);
