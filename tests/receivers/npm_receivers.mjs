// npm's osc and os2l as receivers: plays music and prints, as one line of JSON, what came.
// Usage: node npm_receivers.mjs RAKS MUSIC.wav     in a network namespace of its own, as os2l multicasts
import { execFileSync, spawn } from "node:child_process";
import { OS2LServer } from "os2l";
import osc from "osc";

const [raks, music] = process.argv.slice(2);
execFileSync("ip", ["link", "set", "lo", "up"]);
const said = { messages: {}, bundles: 0, worstTimeTagMs: 0, beats: 0, buttons: [], warnings: 0, lines: 0 };

const udp = new osc.UDPPort({ localAddress: "127.0.0.1", localPort: 7712, metadata: true });
udp.on("message", (message) => {
  const kind = `${message.address} ${message.args.map((each) => each.type).join("")}`;
  said.messages[kind] = (said.messages[kind] ?? 0) + 1;
});
udp.on("bundle", (bundle) => {
  said.bundles += 1;
  said.worstTimeTagMs = Math.max(said.worstTimeTagMs, Math.abs(bundle.timeTag.native - Date.now()));
});
udp.on("error", () => { said.warnings += 1; });
udp.open();

const desk = new OS2LServer({ port: 9996, doPublish: false });
desk.on("beat", () => { said.beats += 1; });
desk.on("btnOn", (name) => said.buttons.push(name));
desk.on("warning", () => { said.warnings += 1; });
await desk.start();

const program = spawn(raks, ["play", "--no-sound", "--headless", "--quit", music, "--lines", "-",
  "--osc", "127.0.0.1:7712", "--os2l", "127.0.0.1"], { stdio: ["ignore", "pipe", "ignore"] });
let text = "";
program.stdout.on("data", (data) => { text += data; });
program.on("close", () => setTimeout(() => {
  said.lines = text.split("\n").filter((line) => line.includes('"do":"beat"')).length;
  console.log(JSON.stringify(said));
  process.exit(0);
}, 300));
