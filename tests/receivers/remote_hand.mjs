// curl's and a page's part in one: asks a running show for every action by HTTP and by WebSocket, and taps
// a tempo by OSC, HTTP and WebSocket through a network that takes 30 +- 10 ms. Prints one line of JSON.
// Usage: node remote_hand.mjs RAKS MUSIC.wav SILENCE.wav     with a display, as every action is asked for
import { spawn } from "node:child_process";
import dgram from "node:dgram";
import { once } from "node:events";
import WebSocket from "ws";

const [raks, music, silence] = process.argv.slice(2);
const kHttp = 17880, kOsc = 17881, kTapped = 111.3;
const url = `http://127.0.0.1:${kHttp}`;
const said = { http: {}, page: {}, refused: {}, taps: {} };
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
// Raks's clock is this one, so that what a page makes of it can be judged.
const clock = () => Number(process.hrtime.bigint()) / 1e6;
let seed = 1;
const random = () => ((seed = (seed * 48271) % 2147483647) / 2147483647);
const delay = () => 20 + 20 * random();

async function start(file, more = ["--headless"]) {
  const program = spawn(raks, ["play", "--no-sound", "--repeat", "--as-live", file, "--remote", "--remote-address",
    `127.0.0.1:${kHttp}`, "--osc-in", `${kOsc}`, ...more], { stdio: ["ignore", "ignore", "pipe"] });
  for await (const text of program.stderr) {
    if (`${text}`.includes("playing")) break;
  }
  return program;
}
async function stop(program) {
  program.kill("SIGINT");
  await once(program, "exit");
}
async function page(options) {
  const socket = new WebSocket(`ws://127.0.0.1:${kHttp}/ws`, options);
  const waits = [];
  const news = { socket, state: null, hello: null };
  socket.on("message", (data) => {
    const message = JSON.parse(data);
    news[message.type] = message;
    const at = waits.findIndex((wait) => wait.type === message.type);
    if (at >= 0) waits.splice(at, 1)[0].done(message);
  });
  news.next = (type) => new Promise((done) => waits.push({ type, done }));
  news.send = (message) => socket.send(JSON.stringify(message));
  await once(socket, "open");
  while (!news.hello || !news.state) await sleep(5);
  return news;
}
// As the page does it.
async function offsetOf(news) {
  const rounds = [];
  for (let i = 0; i < 5; ++i) {
    const sent = performance.now();
    news.send({ clock: sent });
    const answer = await news.next("clock");
    const back = performance.now();
    rounds.push({ way: back - sent, offset: answer.now - (sent + back) / 2 });
  }
  return rounds.reduce((a, b) => (b.way < a.way ? b : a)).offset;
}
const kNames = { dance: "salsa", "forbid-dance": "waltz", "allow-dance": "waltz", formation: "couple",
  avatar: "mannequin", camera: "front", theme: "club", backdrop: "stage", calm: "on", "save-preset": "hand", preset: "hand" };
function valueFor(action, state) {
  if (action.name === "figure") return state.figure;
  if (action.name in kNames) return kNames[action.name];
  return action.kind ? `${Math.min(action.highest, Math.max(action.lowest, action.kind === "step" ? 1 : 2))}` : "";
}
// Those need devices, or end the file.
const isSkipped = (name) => ["source", "loudspeaker", "next-file", "previous-file"].includes(name);
// What is kept first can be taken.
const byTurn = (a, b) => (a.name === "save-preset" ? -1 : 0) - (b.name === "save-preset" ? -1 : 0);

async function everyAction() {
  const program = await start(music, ["--size", "320x240"]);
  const news = await page();
  while (news.state.figure === "") await sleep(50);
  for (const action of news.hello.actions.filter((each) => !isSkipped(each.name)).sort(byTurn)) {
    const value = valueFor(action, news.state);
    const answer = await fetch(`${url}/do/${action.name}`, { method: "POST", body: value });
    said.http[action.name] = answer.status;
    news.send(value === "" ? { do: action.name } : { do: action.name, value });
    said.page[action.name] = (await news.next("answer")).ok;
    await sleep(25); // 50 messages a second are allowed
  }
  const refused = async (name, path, init) => { said.refused[name] = (await fetch(url + path, init)).status; };
  await refused("quit", "/do/quit", { method: "POST" });
  await refused("origin", "/do/tap", { method: "POST", headers: { Origin: "http://evil.example" } });
  await refused("path", "/do/avatar", { method: "POST", body: "/etc/passwd" });
  const foreign = new WebSocket(`ws://127.0.0.1:${kHttp}/ws`, { origin: "http://evil.example" });
  said.refused.handshake = await new Promise((done) => {
    foreign.on("unexpected-response", (_, response) => done(response.statusCode));
    foreign.on("open", () => done(101));
    foreign.on("error", () => {});
  });
  const offset = await offsetOf(news);
  said.clockErrorMs = Math.abs(performance.now() + offset - clock());
  await stop(program);
}

function oscTap() {
  const packet = Buffer.alloc(20);
  packet.write("/raks/do/tap");
  packet.write(",", 16);
  return packet;
}
// 20 taps, each of which leaves a while after the finger came down.
async function taps(way) {
  const program = await start(silence);
  const news = await page();
  const offset = await offsetOf(news);
  const osc = dgram.createSocket("udp4");
  const send = {
    osc: () => osc.send(oscTap(), kOsc, "127.0.0.1"),
    http: () => fetch(`${url}/do/tap`, { method: "POST" }),
    page: (at) => news.send({ do: "tap", at }),
  }[way];
  const period = 60000 / kTapped, first = clock() + 300;
  for (let i = 0; i < 20; ++i) {
    await sleep(first + i * period - clock());
    const at = performance.now() + offset;
    setTimeout(() => send(at), delay());
  }
  await sleep(100);
  await fetch(`${url}/do/hold-tempo`, { method: "POST" });
  while (news.state.beats.length === 0) await sleep(5);
  const { state } = news;
  const phase = (state.beats[0].at - first) / period;
  said.taps[way] = {
    bpm: state.bpm,
    off: Math.abs(state.bpm / kTapped - 1),
    lateMs: (phase - Math.round(phase)) * period,
  };
  osc.close();
  await stop(program);
}

await everyAction();
for (const way of ["osc", "http", "page"]) await taps(way);
console.log(JSON.stringify(said));
process.exit(0);
