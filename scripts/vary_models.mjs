// Writes odd but right variants of a skinned GLB, with its clip: as other programs would have it.
//
//   npm install three                            (in any folder)
//   node scripts/vary_models.mjs NODE_MODULES MODEL.glb OUT_FOLDER
//
// MODEL: one skin, one mesh, one clip without cubic keys, as Khronos' RiggedFigure and CesiumMan. Writes
// MODEL_VARIANT.glb: what three.js draws of each is what it draws of the model, at rest and in the
// clip, but for the hands of `handless`, whose skin hangs on the forearms.
//   cm          the mesh's own space in centimetres
//   zup         the mesh's own space with z up
//   root100     a root scaled to 0.01 over a skeleton in centimetres
//   turnedroot  a root turned by half a turn about y
//   handless    no hand joints
//   lowhips     the hips hang under the first joint of the trunk, which is the root
//   helpers     a joint in the middle of each bone of a limb, on the way to the next
//   poles       targets of pole vectors, "elbow.L" to "knee.R", below the root
//   nameless    joints are called "Bone.007"
//   helpers_nameless, lowhips_nameless, handless_nameless: both
//   posed, posed_cm, posed_root100: the nodes are stored in a pose of the clip, the skin is not bound in it
//   snap        "L_clavicle_bind_JNT", "L_armUpper0001_bind_JNT" and so on, with collar bones
import {readFileSync, writeFileSync} from 'node:fs';
import {basename, join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [modules, file, out] = process.argv.slice(2);
if (!out) {
    console.error('usage: vary_models.mjs NODE_MODULES MODEL.glb OUT_FOLDER');
    process.exit(2);
}
const {Matrix4, Quaternion, Vector3} = await import(pathToFileURL(resolve(modules, 'three/build/three.module.js')));

/// A GLB, whose arrays can be read and replaced.
class Glb {
    constructor(bytes) {
        const length = bytes.readUInt32LE(12);
        this.json = JSON.parse(bytes.subarray(20, 20 + length).toString());
        this.bin = bytes.subarray(28 + length);
    }
    array(index) {
        const {bufferView, byteOffset = 0, componentType, count, type} = this.json.accessors[index];
        const view = this.json.bufferViews[bufferView];
        const size = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16}[type];
        const [bytes, name] = {5121: [1, 'readUInt8'], 5123: [2, 'readUInt16LE'], 5126: [4, 'readFloatLE']}[componentType];
        const stride = view.byteStride ?? bytes * size;
        const all = [];
        for (let i = 0; i < count * size; ++i) {
            all.push(this.bin[name]((view.byteOffset ?? 0) + byteOffset + Math.floor(i / size) * stride + i % size * bytes));
        }
        return all;
    }
    add(values, type, componentType = 5126) {
        const size = {SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16}[type];
        const [bytes, name] = {5123: [2, 'writeUInt16LE'], 5126: [4, 'writeFloatLE']}[componentType];
        const data = Buffer.alloc(Math.ceil(values.length * bytes / 4) * 4);
        values.forEach((value, i) => data[name](value, i * bytes));
        const offset = this.bin.length;
        this.bin = Buffer.concat([this.bin, data]);
        this.json.bufferViews.push({buffer: 0, byteOffset: offset, byteLength: values.length * bytes});
        const accessor = {bufferView: this.json.bufferViews.length - 1, componentType, count: values.length / size, type};
        if (type === 'SCALAR' || type === 'VEC3') {
            accessor.min = Array(size).fill(Infinity);
            accessor.max = Array(size).fill(-Infinity);
            values.forEach((value, i) => {
                accessor.min[i % size] = Math.min(accessor.min[i % size], Math.fround(value));
                accessor.max[i % size] = Math.max(accessor.max[i % size], Math.fround(value));
            });
        }
        this.json.accessors.push(accessor);
        return this.json.accessors.length - 1;
    }
    write(path) {
        const {bin} = this;
        this.json.buffers[0].byteLength = bin.length;
        let text = JSON.stringify(this.json);
        text += ' '.repeat((4 - Buffer.byteLength(text) % 4) % 4);
        const head = Buffer.alloc(20);
        head.write('glTF');
        head.writeUInt32LE(2, 4);
        head.writeUInt32LE(28 + Buffer.byteLength(text) + bin.length, 8);
        head.writeUInt32LE(Buffer.byteLength(text), 12);
        head.write('JSON', 16);
        const chunk = Buffer.alloc(8);
        chunk.writeUInt32LE(bin.length, 0);
        chunk.write('BIN\0', 4);
        writeFileSync(path, Buffer.concat([head, Buffer.from(text), chunk, bin]));
    }
}

/// A figure: nodes with parents, their worlds at rest and at each key, and its skin.
class Figure {
    constructor(bytes) {
        this.glb = new Glb(bytes);
        const {json} = this.glb;
        this.nodes = json.nodes.map((node) => ({...node, parent: -1}));
        json.nodes.forEach((node, i) => (node.children ?? []).forEach((child) => this.nodes[child].parent = i));
        this.skin = json.skins[0];
        this.inverse = this.chunks(this.glb.array(this.skin.inverseBindMatrices), 16).map((m) => new Matrix4().fromArray(m));
        this.primitive = json.meshes[json.nodes.find((node) => node.skin !== undefined).mesh].primitives[0];
        const {channels, samplers} = json.animations[0];
        this.times = this.glb.array(samplers[channels[0].sampler].input);
        this.rest = this.worlds(this.nodes.map((node) => node));
        this.frames = this.times.map((_, frame) => {
            const moved = this.nodes.map((node) => ({...node}));
            for (const {sampler, target} of channels) {
                const values = this.glb.array(samplers[sampler].output);
                const size = target.path === 'rotation' ? 4 : 3;
                const keys = this.glb.array(samplers[sampler].input);
                const key = keys.findIndex((time) => Math.abs(time - this.times[frame]) < 1e-4);
                if (key >= 0) {
                    delete moved[target.node].matrix;
                    Object.assign(moved[target.node], this.parts(this.nodes[target.node]), {...(moved[target.node].moved ?? {})});
                    moved[target.node].moved = {...(moved[target.node].moved ?? {}), [target.path]: values.slice(key * size, key * size + size)};
                    Object.assign(moved[target.node], moved[target.node].moved);
                }
            }
            return this.worlds(moved);
        });
    }
    chunks(all, size) {
        return Array.from({length: all.length / size}, (_, i) => all.slice(i * size, i * size + size));
    }
    parts(node) {
        if (!node.matrix) {
            return {translation: node.translation ?? [0, 0, 0], rotation: node.rotation ?? [0, 0, 0, 1], scale: node.scale ?? [1, 1, 1]};
        }
        const [t, r, s] = [new Vector3(), new Quaternion(), new Vector3()];
        new Matrix4().fromArray(node.matrix).decompose(t, r, s);
        return {translation: t.toArray(), rotation: r.toArray(), scale: s.toArray()};
    }
    worlds(nodes) {
        const all = [];
        const world = (i) => {
            if (i < 0) {
                return new Matrix4();
            }
            if (!all[i]) {
                const {translation, rotation, scale} = this.parts(nodes[i]);
                all[i] = world(this.nodes[i].parent).clone().multiply(new Matrix4().compose(
                    new Vector3(...translation), new Quaternion(...rotation), new Vector3(...scale)));
            }
            return all[i];
        };
        nodes.forEach((_, i) => world(i));
        return all;
    }
    named(part) {
        return this.nodes.findIndex((node) => (node.name ?? '').includes(part));
    }
    /// Adds a joint at a place in the world of a node, which moves as that does.
    addJoint(name, parent, carrier, place) {
        const at = (worlds) => {
            const world = worlds[carrier].clone();
            return world.multiply(new Matrix4().makeTranslation(...place.clone().applyMatrix4(this.rest[carrier].clone().invert())));
        };
        this.nodes.push({name, parent});
        [this.rest, ...this.frames].forEach((worlds) => worlds.push(at(worlds)));
        const node = this.nodes.length - 1;
        this.skin.joints.push(node);
        const j = this.skin.joints.indexOf(carrier);
        // Its bind place stands to the carrier's as its rest place does.
        this.inverse.push(this.rest[node].clone().invert().multiply(this.rest[carrier]).multiply(this.inverse[j]));
        return node;
    }
    /// Writes what the worlds are with the parents that the nodes have now.
    save(path) {
        const {json} = this.glb;
        const local = (worlds, i) => {
            const parent = this.nodes[i].parent;
            const matrix = (parent < 0 ? new Matrix4() : worlds[parent].clone().invert()).multiply(worlds[i]);
            const [t, r, s] = [new Vector3(), new Quaternion(), new Vector3()];
            matrix.decompose(t, r, s);
            return {translation: t.toArray(), rotation: r.normalize().toArray(), scale: s.toArray()};
        };
        json.nodes = this.nodes.map(({name, mesh, skin}, i) => ({name, mesh, skin, ...local(this.rest, i)}));
        this.nodes.forEach((node, i) => {
            if (node.parent >= 0) {
                (json.nodes[node.parent].children ??= []).push(i);
            }
        });
        json.scenes = [{nodes: this.nodes.flatMap((node, i) => node.parent < 0 ? [i] : [])}];
        json.scene = 0;
        delete this.skin.skeleton;
        this.skin.inverseBindMatrices = this.glb.add(this.inverse.flatMap((m) => m.elements), 'MAT4');
        const input = this.glb.add(this.times, 'SCALAR');
        const animation = {channels: [], samplers: []};
        for (const node of this.skin.joints) {
            const keys = this.frames.map((worlds) => local(worlds, node));
            for (const [key, type] of [['translation', 'VEC3'], ['rotation', 'VEC4'], ['scale', 'VEC3']]) {
                animation.samplers.push({input, output: this.glb.add(keys.flatMap((one) => one[key]), type)});
                animation.channels.push({sampler: animation.samplers.length - 1, target: {node, path: key}});
            }
        }
        json.animations = [animation];
        this.glb.write(path);
    }
    /// Turns or scales the mesh's own space.
    meshSpace(matrix) {
        const place = this.chunks(this.glb.array(this.primitive.attributes.POSITION), 3).flatMap((p) => new Vector3(...p).applyMatrix4(matrix).toArray());
        this.primitive.attributes.POSITION = this.glb.add(place, 'VEC3');
        const turn = new Matrix4().extractRotation(matrix);
        const normals = this.chunks(this.glb.array(this.primitive.attributes.NORMAL), 3).flatMap((p) => new Vector3(...p).applyMatrix4(turn).toArray());
        this.primitive.attributes.NORMAL = this.glb.add(normals, 'VEC3');
        const back = matrix.clone().invert();
        this.inverse.forEach((m) => m.multiply(back));
    }
    /// Puts a node over all others, with the skeleton's worlds as they are: `root` is its local.
    under(root) {
        this.nodes.push({name: 'Root', parent: -1});
        [this.rest, ...this.frames].forEach((worlds) => worlds.push(root));
        this.nodes.forEach((node, i) => {
            node.parent = node.parent < 0 && i + 1 < this.nodes.length ? this.nodes.length - 1 : node.parent;
        });
    }
    removeJoint(node) {
        const j = this.skin.joints.indexOf(node);
        const onto = this.skin.joints.indexOf(this.nodes[node].parent);
        const joints = this.glb.array(this.primitive.attributes.JOINTS_0).map((at) => {
            const to = at === j ? onto : at;
            return to > j ? to - 1 : to;
        });
        this.primitive.attributes.JOINTS_0 = this.glb.add(joints, 'VEC4', 5123);
        this.skin.joints.splice(j, 1);
        this.inverse.splice(j, 1);
        this.nodes.forEach((one) => one.parent = one.parent === node ? this.nodes[node].parent : one.parent > node ? one.parent - 1 : one.parent);
        [this.nodes, this.rest, ...this.frames].forEach((list) => list.splice(node, 1));
        this.skin.joints = this.skin.joints.map((one) => one > node ? one - 1 : one);
    }
}

const chains = (figure) => {
    const below = (node) => {
        const child = figure.nodes.findIndex((one, i) => one.parent === node && figure.skin.joints.includes(i));
        return child < 0 ? [node] : [node, ...below(child)];
    };
    const start = (words) => figure.nodes.findIndex((node, i) => words.every((word) => (node.name ?? '').includes(word)) &&
        figure.skin.joints.includes(i) && !(figure.nodes[node.parent].name ?? '').includes(words[0]));
    return {armL: below(start(['arm_joint', '_L'])), armR: below(start(['arm_joint', '_R'])), legL: below(start(['leg_joint', '_L'])), legR: below(start(['leg_joint', '_R']))};
};
const placeOf = (figure, node) => new Vector3().setFromMatrixPosition(figure.rest[node]);
const between = (figure, a, b, share = 0.5) => placeOf(figure, a).lerp(placeOf(figure, b), share);
const nameless = (figure) => figure.skin.joints.forEach((node, i) => figure.nodes[node].name = `Bone.${String(i).padStart(3, '0')}`);
const handless = (figure) => ['armL', 'armR'].forEach((arm) => figure.removeJoint(chains(figure)[arm][2]));
function lowhips(figure) {
    const [hips, spine] = [figure.named('torso_joint_1'), figure.named('torso_joint_2')];
    figure.nodes[spine].parent = figure.nodes[hips].parent;
    figure.nodes[hips].parent = spine;
}
function helpers(figure) {
    for (const [limb, way] of Object.entries(chains(figure))) {
        for (let i = 0; i < 2; ++i) {
            figure.nodes[way[i + 1]].parent = figure.addJoint(`${limb}_helper_${i}`, way[i], way[i], between(figure, way[i], way[i + 1]));
        }
    }
}
function snap(figure) {
    const trunk = figure.named('torso_joint_3');
    for (const [limb, way] of Object.entries(chains(figure))) {
        const side = limb.at(-1);
        const names = limb.startsWith('arm') ? ['armUpper0001', 'armLower0001', 'hand0001'] : ['legUpper0001', 'legLower0001', 'foot0001', 'toe0001'];
        names.forEach((name, i) => figure.nodes[way[i]].name = `${side}_${name}_bind_JNT`);
        if (limb.startsWith('arm')) {
            figure.nodes[way[0]].parent = figure.addJoint(`${side}_clavicle_bind_JNT`, trunk, trunk, between(figure, trunk, way[0], 0.2));
        }
    }
    [['torso_joint_1', 'C_pelvis_bind_JNT'], ['torso_joint_2', 'C_spine0001_bind_JNT'], ['torso_joint_3', 'C_spine0002_bind_JNT'],
     ['neck_joint_1', 'C_neck0001_bind_JNT'], ['neck_joint_2', 'C_head_bind_JNT']].forEach(([from, to]) => figure.nodes[figure.named(from)].name = to);
}
function poles(figure) {
    const {armL, armR, legL, legR} = chains(figure);
    const root = figure.nodes[figure.named('torso_joint_1')].parent;
    const forward = new Vector3(0, 0, 0.4);
    const hips = figure.named('torso_joint_1');
    [['elbow.L', armL, -1], ['elbow.R', armR, -1], ['knee.L', legL, 1], ['knee.R', legR, 1]].forEach(([name, way, sign]) =>
        figure.addJoint(name, root, hips, placeOf(figure, way[1]).addScaledVector(forward, sign)));
}
const posed = (figure) => figure.rest = figure.frames[Math.floor(figure.frames.length / 3)].map((world) => world.clone());
const variants = {
    cm: (figure) => figure.meshSpace(new Matrix4().makeScale(100, 100, 100)),
    zup: (figure) => figure.meshSpace(new Matrix4().makeRotationX(Math.PI / 2)),
    root100: (figure) => {
        // The joints' own axes are scaled with the root, as their bind matrices are.
        figure.under(new Matrix4().makeScale(0.01, 0.01, 0.01));
        const large = new Matrix4().makeScale(0.01, 0.01, 0.01);
        const joints = new Set(figure.skin.joints);
        [figure.rest, ...figure.frames].forEach((worlds) => joints.forEach((node) => worlds[node] = worlds[node].clone().multiply(large)));
        figure.inverse.forEach((m) => m.premultiply(large.clone().invert()));
    },
    turnedroot: (figure) => {
        const turn = new Matrix4().makeRotationY(Math.PI);
        figure.under(new Matrix4());
        [figure.rest, ...figure.frames].forEach((worlds) => worlds.forEach((world, i) => worlds[i] = turn.clone().multiply(world)));
    },
    handless, lowhips, helpers, poles, nameless, snap, posed,
    posed_cm: (figure) => (posed(figure), variants.cm(figure)),
    posed_root100: (figure) => (variants.root100(figure), posed(figure)),
    helpers_nameless: (figure) => (helpers(figure), nameless(figure)),
    lowhips_nameless: (figure) => (lowhips(figure), nameless(figure)),
    handless_nameless: (figure) => (handless(figure), nameless(figure)),
};
for (const [name, change] of Object.entries(variants)) {
    const figure = new Figure(readFileSync(file));
    change(figure);
    figure.save(join(out, `${basename(file, '.glb')}_${name}.glb`));
}
