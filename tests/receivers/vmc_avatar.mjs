// npm's osc and pixiv's three-vrm as a marionette in Chromium: a dance is told by VMC to the same VRM there, and a
// picture of eight of its moments is kept, to be looked at. Prints one line of JSON: frames, bones and expressions that
// the avatar knows, and how far a foot stood above the floor or below it.
// Usage: node vmc_avatar.mjs CHROMIUM RAKS MUSIC.wav AVATAR.vrm PICTURE.png
// Needs npm's three (0.160), @pixiv/three-vrm (3), osc and ws in node_modules beside it.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import osc from "osc";
import WebSocket from "ws";

const [chromium, raks, music, avatar, picture] = process.argv.slice(2);
const kMoments = 8;
const kPort = 17715;
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const said = { frames: 0, faults: [] };

const page = `<!doctype html><style>body{margin:0}</style><script type="importmap">{"imports":{
  "three":"/node_modules/three/build/three.module.js","three/addons/":"/node_modules/three/examples/jsm/",
  "@pixiv/three-vrm":"/node_modules/@pixiv/three-vrm/lib/three-vrm.module.js"}}</script><script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { VRMLoaderPlugin, VRMUtils } from "@pixiv/three-vrm";
const kNames = { Joy: "happy", Angry: "angry", Sorrow: "sad", Fun: "relaxed", Surprised: "surprised", Neutral: "neutral",
  A: "aa", I: "ih", U: "ou", E: "ee", O: "oh", Blink: "blink", Blink_L: "blinkLeft", Blink_R: "blinkRight",
  LookUp: "lookUp", LookDown: "lookDown", LookLeft: "lookLeft", LookRight: "lookRight" };
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(1600, 500);
renderer.autoClear = false;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xe8e8f0);
scene.add(new THREE.DirectionalLight(0xffffff, 2.5), new THREE.AmbientLight(0xffffff, 0.7), new THREE.GridHelper(6, 12));
const camera = new THREE.PerspectiveCamera(30, 200 / 500, 0.1, 20);
camera.position.set(0, 1.1, 5.2);
camera.lookAt(0, 0.85, 0);
const loader = new GLTFLoader();
loader.register((parser) => new VRMLoaderPlugin(parser));
const vrm = (await loader.loadAsync("/avatar.vrm")).userData.vrm;
vrm.humanoid.autoUpdateHumanBones = false;
const isOld = vrm.meta.metaVersion === "0";
if (isOld) VRMUtils.rotateVRM0(vrm);
scene.add(vrm.scene);
const nodes = {};
for (const name of Object.keys(vrm.humanoid.rawHumanBones)) {
  const unity = name[0].toUpperCase() + name.slice(1);
  nodes[unity.replace("ThumbProximal", "ThumbIntermediate").replace("ThumbMetacarpal", "ThumbProximal")] =
    vrm.humanoid.getRawBoneNode(name);
}
let moments = 0;
window.show = (frame, column) => {
  let known = 0;
  for (const [name, [x, y, z, qx, qy, qz, qw]] of Object.entries(frame.bones)) {
    const node = nodes[name];
    if (!node) continue;
    ++known;
    if (isOld) { node.position.set(x, y, -z); node.quaternion.set(-qx, -qy, qz, qw); }
    else { node.position.set(-x, y, z); node.quaternion.set(qx, -qy, -qz, qw); }
  }
  for (const [name, weight] of Object.entries(frame.face)) vrm.expressionManager?.setValue(kNames[name] ?? name, weight);
  vrm.update(1 / 60);
  renderer.setViewport(200 * column, 0, 200, 500);
  renderer.setScissor(200 * column, 0, 200, 500);
  renderer.setScissorTest(true);
  renderer.clear();
  renderer.render(scene, camera);
  const low = ["LeftToes", "RightToes", "LeftFoot", "RightFoot"].filter((name) => nodes[name]).map((name) =>
    nodes[name].getWorldPosition(new THREE.Vector3()).y);
  return { known, bones: Object.keys(nodes).length, lowest: Math.min(...low) };
};
window.ready = true;
</script>`;
const kinds = { js: "text/javascript", vrm: "model/gltf-binary" };
const server = createServer((request, response) => {
  try {
    const path = new URL(request.url, "http://x").pathname;
    const body = path === "/" ? page : readFileSync(path === "/avatar.vrm" ? avatar : join(import.meta.dirname, path));
    response.writeHead(200, { "Content-Type": path === "/" ? "text/html" : kinds[path.split(".").pop()] ?? "text/plain" });
    response.end(body);
  } catch {
    response.writeHead(404).end();
  }
}).listen(0, "127.0.0.1");
await once(server, "listening");

const folder = mkdtempSync(join(tmpdir(), "raks_chromium_"));
const browser = spawn(chromium, ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--remote-debugging-port=0", `--user-data-dir=${folder}`, "about:blank"], { stdio: ["ignore", "ignore", "pipe"] });
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
  else if (message.method === "Runtime.exceptionThrown") said.faults.push(
    message.params.exceptionDetails.exception?.description ?? message.params.exceptionDetails.text);
});
const call = (method, params = {}) => new Promise((done) => {
  waits.set(++number, done);
  socket.send(JSON.stringify({ id: number, method, params }));
});
const value = async (expression) =>
  (await call("Runtime.evaluate", { expression, returnByValue: true })).result.value;
for (const domain of ["Runtime", "Page"]) await call(`${domain}.enable`);
await call("Emulation.setDeviceMetricsOverride", { width: 1600, height: 500, deviceScaleFactor: 1, mobile: false });
await call("Page.navigate", { url: `http://127.0.0.1:${server.address().port}/` });
while (!(await value("window.ready === true"))) {
  if (said.faults.length > 0) { console.log(JSON.stringify(said)); process.exit(1); }
  await sleep(50);
}

let bones = {}, face = {}, values = {}, whole = null;
const udp = new osc.UDPPort({ localAddress: "127.0.0.1", localPort: kPort, metadata: false });
udp.on("message", ({ address, args }) => {
  if (address === "/VMC/Ext/Bone/Pos") bones[args[0]] = args.slice(1);
  else if (address === "/VMC/Ext/Blend/Val") values[args[0]] = args[1];
  else if (address === "/VMC/Ext/Blend/Apply") { face = values; values = {}; }
  else if (address === "/VMC/Ext/T") { whole = { bones, face }; bones = {}; said.frames += 1; }
});
udp.on("error", (error) => said.faults.push(String(error)));
udp.open();
const program = spawn(raks, ["play", "--no-sound", "--headless", "--quit", music, "--avatar", avatar, "--vmc",
  `127.0.0.1:${kPort},way=0.5`], { stdio: "ignore" });
while (whole === null) await sleep(20);
for (let moment = 0; moment < kMoments; ++moment) {
  await sleep(900);
  Object.assign(said, await value(`show(${JSON.stringify(whole)}, ${moment})`));
}
const shot = await call("Page.captureScreenshot", { format: "png" });
writeFileSync(picture, Buffer.from(shot.data, "base64"));
program.kill("SIGTERM");
browser.kill();
await once(browser, "exit");
rmSync(folder, { recursive: true, force: true });
console.log(JSON.stringify(said));
process.exit(0);
