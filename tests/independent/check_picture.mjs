// node check_picture.mjs MODEL.glb SECONDS OURS.png OUT.png: how three.js draws a dance in a headless
// Chromium, beside what `raks avatar pose` drew. One JSON line on stdout: pixels of the dress in
// both pictures, the part of them that is in both of all that is in either, or why it was skipped.
// OUT.png: both pictures, side by side.
import {spawn, spawnSync} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';

const [model, seconds, ours, out] = process.argv.slice(2);
const browsers = ['chromium-headless-shell', 'chromium', 'chromium-browser', 'google-chrome'];
const browser = browsers.find((name) => spawnSync(name, ['--version']).status === 0);
if (!browser) {
  console.log(JSON.stringify({skipped: 'Chromium is not installed'}));
  process.exit(0);
}

const types = {'.html': 'text/html', '.js': 'text/javascript', '.png': 'image/png'};
const files = {'/': 'picture_page.html', '/model': model, '/ours.png': ours};

function fileOf(address) {
  if (files[address]) return files[address];
  const file = path.normalize(`.${address}`);
  return file.startsWith('node_modules/') && fs.existsSync(file) ? file : null;
}

let finish;
const result = new Promise((done) => finish = done);
const server = http.createServer((request, response) => {
  if (request.method === 'POST') {
    const parts = [];
    request.on('data', (part) => parts.push(part));
    request.on('end', () => {
      response.end();
      finish(JSON.parse(Buffer.concat(parts).toString()));
    });
    return;
  }
  const file = fileOf(new URL(request.url, 'http://here').pathname);
  response.writeHead(file ? 200 : 404, {'content-type': types[path.extname(file ?? '')] ?? ''});
  response.end(file ? fs.readFileSync(file) : '');
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));

const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'raks-chromium-'));
const options = [
  '--headless', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--disable-background-networking', '--no-first-run', `--user-data-dir=${profile}`,
  '--remote-debugging-port=0',  // else the shell ends as soon as the page stands
];
if (process.getuid() === 0) options.push('--no-sandbox');
const page = `http://127.0.0.1:${server.address().port}/?seconds=${seconds}`;
// In a group of its own: Debian starts it by a script, and it starts others.
const child = spawn(browser, [...options, page], {stdio: 'ignore', detached: true});
const ended = new Promise((done) => child.on('exit', (code) => done({error: `${browser} ended: ${code}`})));
const late = new Promise(
    (done) => setTimeout(() => done({error: 'the page did not answer'}), 120_000).unref());
const answer = await Promise.race([result, ended, late]);
if (child.exitCode === null) process.kill(-child.pid, 'SIGKILL');
await ended;
fs.rmSync(profile, {recursive: true, force: true});
if (answer.picture) fs.writeFileSync(out, Buffer.from(answer.picture.split(',')[1], 'base64'));
delete answer.picture;
console.log(JSON.stringify({browser, ...answer}));
process.exit(0);
