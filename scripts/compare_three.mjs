// Compares models as Raks has them with what three.js makes of them, vertex by vertex.
//
//   npm install three @xmldom/xmldom            (in any folder)
//   node scripts/compare_three.mjs NODE_MODULES RAKS MODEL...
//
// MODEL: .glb, .gltf, .vrm, .fbx, .dae, .3ds or .obj. RAKS: the program. Prints a row for each model,
// with columns between tabs:
//   model     its file's name
//   three_m   height at rest by three.js, metres (its FBX times unit / 100)
//   raks_m    the same by `raks avatar show`
//   dances_m  how tall it dances; -: it does not
//   facing    by `raks avatar show` / by `raks stick`, which must say the same; -: unknown
//   bones     how many are found / how many of them `raks stick` has otherwise
//   rest_mm   50 vertices at rest: the farthest from three.js', thousandths of the height
//   clip_mm   the same in the middle of the first clip, after the best turn about y and the best
//             shift, since Raks turns a figure to the front and stands it on the floor; -: no clip
//   said      why it is no figure that dances
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, dirname, extname, join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [modules, raks, ...models] = process.argv.slice(2);
if (!models.length) {
    console.error('usage: compare_three.mjs NODE_MODULES RAKS MODEL...');
    process.exit(2);
}
const load = (name) => import(pathToFileURL(resolve(modules, name)));
globalThis.self = globalThis;
globalThis.window ??= globalThis;
globalThis.ProgressEvent ??= class {};
const THREE = await load('three/build/three.module.js');
const {GLTFLoader} = await load('three/examples/jsm/loaders/GLTFLoader.js');
const {FBXLoader} = await load('three/examples/jsm/loaders/FBXLoader.js');
const {OBJLoader} = await load('three/examples/jsm/loaders/OBJLoader.js');
const {TDSLoader} = await load('three/examples/jsm/loaders/TDSLoader.js');
const {ColladaLoader} = await load('three/examples/jsm/loaders/ColladaLoader.js');
const {MeshoptDecoder} = await load('three/examples/jsm/libs/meshopt_decoder.module.js');
globalThis.DOMParser ??= (await load('@xmldom/xmldom/lib/index.js')).DOMParser;
THREE.TextureLoader.prototype.load = THREE.DataTextureLoader.prototype.load = () => new THREE.Texture();
const print = console.log;
console.log = console.warn = console.error = () => {};

const kVertices = 50;

/// A model by three.js: its scene, clips, and metres from its unit.
async function byThree(file) {
    const bytes = readFileSync(file);
    const data = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    const folder = dirname(resolve(file)) + '/';
    switch (extname(file).toLowerCase()) {
        case '.fbx': {
            const scene = new FBXLoader().parse(data, folder);
            const unit = bytes.includes('UnitScaleFactor') ? unitOfFbx(bytes) : 1;
            return {scene, clips: scene.animations, metres: unit / 100};
        }
        case '.dae': {
            const read = new ColladaLoader().parse(bytes.toString(), folder);
            return {scene: read.scene, clips: read.scene.animations ?? [], metres: 1};
        }
        case '.obj':
            return {scene: new OBJLoader().parse(bytes.toString()), clips: [], metres: 1};
        case '.3ds': {
            const scene = new TDSLoader().parse(data, folder);
            const turned = new THREE.Group();
            turned.add(scene);
            scene.rotation.x = -Math.PI / 2;
            return {scene: turned, clips: [], metres: 1};
        }
        default: {
            const loader = new GLTFLoader();
            loader.setMeshoptDecoder(MeshoptDecoder);
            loader.register((parser) => {
                parser.loadTexture = parser.loadTextureImage = async () => new THREE.Texture();
                parser.getDependency = ((get) => (type, index) =>
                    type === 'buffer' && bufferFile(parser, index, folder) || get.call(parser, type, index)
                )(parser.getDependency);
                return {name: 'no textures'};
            });
            const read = await loader.parseAsync(data, folder);
            return {scene: read.scene, clips: read.animations, metres: 1, parser: read.parser};
        }
    }
}

/// A buffer that lies beside a .gltf, which node's fetch does not read.
function bufferFile(parser, index, folder) {
    const uri = parser.json.buffers?.[index]?.uri;
    if (!uri || uri.startsWith('data:')) {
        return null;
    }
    const bytes = readFileSync(join(folder, decodeURIComponent(uri)));
    return Promise.resolve(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

/// The factor behind the last number of the property, binary or text.
function unitOfFbx(bytes) {
    const at = bytes.indexOf('UnitScaleFactor');
    if (bytes.subarray(0, 18).toString() !== 'Kaydara FBX Binary') {
        return Number(/UnitScaleFactor"[^\n]*,\s*([-\d.e+]+)\s*$/m.exec(bytes.toString())?.[1] ?? 1);
    }
    // Past the flags of the property, which are a text that may be empty.
    for (let i = bytes.indexOf('Number', at) + 6; i < at + 80; ++i) {
        if (bytes[i] === 0x44 && Number.isFinite(bytes.readDoubleLE(i + 1)) && bytes.readDoubleLE(i + 1) > 1e-3) {
            return bytes.readDoubleLE(i + 1);
        }
    }
    return 1;
}

/// World places of all vertices, by mesh.
function vertices({scene, metres}) {
    scene.updateMatrixWorld(true);
    const all = [];
    scene.traverse((object) => {
        if (!object.isMesh) {
            return;
        }
        const place = new THREE.Vector3();
        const count = object.geometry.attributes.position.count;
        for (let i = 0; i < count; ++i) {
            object.getVertexPosition(i, place).applyMatrix4(object.matrixWorld);
            all.push(place.x * metres, place.y * metres, place.z * metres);
        }
    });
    return all;
}

function obj(file) {
    const all = [];
    for (const line of readFileSync(file, 'utf8').split('\n')) {
        if (line.startsWith('v ')) {
            all.push(...line.split(' ').slice(1, 4).map(Number));
        }
    }
    return all;
}

const run = (...words) => execFileSync(raks, words, {stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 28}).toString();
function json(...words) {
    try {
        return JSON.parse(run(...words));
    } catch (error) {
        return {error: String(error.stderr ?? error).trim().split('\n').pop() || 'refused'};
    }
}

const extent = (all) => {
    let low = Infinity, high = -Infinity;
    for (let i = 1; i < all.length; i += 3) {
        low = Math.min(low, all[i]);
        high = Math.max(high, all[i]);
    }
    return high - low;
};

/// For vertices spread over the mesh the nearest vertex of Raks, as pairs of numbers.
function pairs(three, own) {
    const count = three.length / 3;
    const found = [];
    for (let k = 0; k < Math.min(kVertices, count); ++k) {
        const i = Math.floor(k * count / Math.min(kVertices, count));
        let best = 0, least = Infinity;
        for (let j = 0; j < own.length / 3; ++j) {
            const away = Math.hypot(three[3 * i] - own[3 * j], three[3 * i + 1] - own[3 * j + 1], three[3 * i + 2] - own[3 * j + 2]);
            if (away < least) {
                least = away;
                best = j;
            }
        }
        found.push([i, best]);
    }
    return found;
}

const at = (all, i) => [all[3 * i], all[3 * i + 1], all[3 * i + 2]];

/// The farthest that pairs are apart; `fits`: after the best turn about y and shift.
function farthest(three, own, all, fits) {
    let turn = 0, from = [0, 0, 0], to = [0, 0, 0];
    if (fits) {
        for (const [i, j] of all) {
            at(three, i).forEach((x, axis) => from[axis] += x / all.length);
            at(own, j).forEach((x, axis) => to[axis] += x / all.length);
        }
        let sine = 0, cosine = 0;
        for (const [i, j] of all) {
            const a = at(three, i), b = at(own, j);
            const [ax, az, bx, bz] = [a[0] - from[0], a[2] - from[2], b[0] - to[0], b[2] - to[2]];
            cosine += ax * bx + az * bz;
            sine += az * bx - ax * bz;
        }
        turn = Math.atan2(sine, cosine);
    }
    const [s, c] = [Math.sin(turn), Math.cos(turn)];
    return Math.max(...all.map(([i, j]) => {
        const [x, y, z] = at(three, i).map((v, axis) => v - from[axis]);
        const b = at(own, j).map((v, axis) => v - to[axis]);
        return Math.hypot(c * x + s * z - b[0], y - b[1], c * z - s * x - b[2]);
    }));
}

const degrees = {'+Z': 0, '+X': 90, '-Z': 180, '-X': -90};
const facingText = (degree) => degree === undefined ? '-' : String(Math.round(degree));

async function row(file, folder) {
    const shown = json('avatar', 'show', file, '--json');
    const stick = json('stick', file, '--json');
    const words = {model: basename(file), three_m: '-', raks_m: '-', dances_m: '-', facing: '-', bones: '-', rest_mm: '-', clip_mm: '-', said: shown.error ?? ''};
    if (!shown.error) {
        words.raks_m = shown.height_m?.toFixed(4) ?? '-';
        words.dances_m = shown.dances_at_m?.toFixed(3) ?? '-';
        const bones = Object.entries(shown.humanoid).filter(([bone]) => !['leftEye', 'rightEye', 'jaw'].includes(bone));
        const joints = stick.joints ?? {};
        const isStated = bones.some(([, bone]) => bone.reason === 'named in the file');
        const other = stick.joints ? bones.filter(([bone, {name}]) => isStated ? joints[bone] === undefined : joints[bone]?.joint !== name).length : '-';
        words.bones = `${bones.length}/${other}`;
        words.facing = `${shown.facing ?? '-'}/${facingText(stick.facing?.degrees)}`;
        words.said = (shown.warnings ?? []).filter((line) => line.includes('cannot dance') || line.includes('doubtful') || line.includes('not by its names')).join('; ');
    }
    let three;
    try {
        three = await byThree(file);
    } catch (error) {
        words.said += ` three.js: ${String(error.message).split('\n')[0]}`;
        return words;
    }
    const rest = vertices(three);
    const height = extent(rest);
    if (!(height > 0)) {
        return words;
    }
    words.three_m = height.toFixed(4);
    try {
        const out = join(folder, 'rest.obj');
        run('avatar', 'export', out, '--from', file);
        const own = obj(out);
        if (extname(file) === '.vrm' && shown.facing === '-Z') {  // VRM 0.x is written facing +z
            own.forEach((_, i) => own[i] *= i % 3 === 1 ? 1 : -1);
        }
        const all = pairs(rest, own);
        words.rest_mm = (1000 * farthest(rest, own, all, false) / height).toFixed(2);
        if (three.clips.length && words.dances_m !== '-') {
            const clip = three.clips[0];
            const time = clip.duration / 2;
            const mixer = new THREE.AnimationMixer(three.scene);
            mixer.clipAction(clip).play();
            mixer.setTime(time);
            const posed = join(folder, 'posed.obj');
            const name = three.clips.length > 1 ? `${file}#${clip.name}` : file;
            run('avatar', 'pose', file, '--motion', name, '--time', String(time.toFixed(4)), '-o', posed);
            words.clip_mm = (1000 * farthest(vertices(three), obj(posed), all, true) / height).toFixed(2);
        }
    } catch (error) {
        words.said += ' ' + String(error.stderr ?? error).trim().split('\n').pop();
    }
    return words;
}

const folder = mkdtempSync(join(tmpdir(), 'three-'));
try {
    let isFirst = true;
    for (const file of models) {
        const words = await row(file, folder);
        if (isFirst) {
            print(Object.keys(words).join('\t'));
            isFirst = false;
        }
        print(Object.values(words).join('\t'));
    }
} finally {
    rmSync(folder, {recursive: true});
}
