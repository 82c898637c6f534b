// node check_vmd.mjs MOTION.vmd BODY.json: how babylon-mmd poses a VMD on the skeleton of BODY.json,
// against the places in it. BODY.json, in the file's own axes and units: `bones`, each {name,
// parent, rest: [x, y, z] from the parent, level, append: {bone, share}, axis, ik: {target, rounds,
// step, links: [{bone, knee}]}}, and `frames`, each {frame, places: [[x, y, z], ...]} by bone. One
// JSON line on stdout: places compared, the largest distance in units and where it is.
import fs from 'node:fs';
import {register} from 'node:module';

// babylon-mmd imports files without their ending.
register('data:text/javascript,' + encodeURIComponent(`
export async function resolve(specifier, context, next) {
  try {
    return await next(specifier, context);
  } catch (fault) {
    if (/[.]m?js$/.test(specifier)) throw fault;
    return next(specifier + '.js', context);
  }
}`));
const {Logger} = await import('@babylonjs/core/Misc/logger');
Logger.LogLevels = Logger.NoneLogLevel;  // the engine greets
const {NullEngine} = await import('@babylonjs/core/Engines/nullEngine');
const {Scene} = await import('@babylonjs/core/scene');
const {Matrix, Quaternion, Vector3} = await import('@babylonjs/core/Maths/math.vector');
const {VmdLoader} = await import('babylon-mmd/esm/Loader/vmdLoader');
const {MmdRuntime} = await import('babylon-mmd/esm/Runtime/mmdRuntime');
await import('babylon-mmd/esm/Runtime/Animation/mmdRuntimeModelAnimation');


const [motionFile, bodyFile] = process.argv.slice(2);
const body = JSON.parse(fs.readFileSync(bodyFile, 'utf8'));

// A bone as MmdRuntime asks for it.
class PlainBone {
  constructor(name, rest) {
    this.name = name;
    this.scaling = new Vector3(1, 1, 1);
    this.rotationQuaternion = new Quaternion();
    this.place = Vector3.FromArray(rest);
    this.restMatrix = Matrix.Translation(...rest);
    this.inverseBind = Matrix.Identity();
  }
  get position() { return this.place; }
  set position(value) { this.place.copyFrom(value); }
  getRestMatrix() { return this.restMatrix; }
  getAbsoluteInverseBindMatrix() { return this.inverseBind; }
  setRotationQuaternion(value) { this.rotationQuaternion.copyFrom(value); }
}

const kRotates = 2, kMoves = 4, kSolves = 32, kAppendsTurn = 256, kOneAxis = 1024;
const kneeLimits = {minimumAngle: [-Math.PI, 0, 0], maximumAngle: [-0.5 * Math.PI / 180, 0, 0]};
const metadata = body.bones.map((bone) => ({
  name: bone.name,
  englishName: '',
  parentBoneIndex: bone.parent,
  transformOrder: bone.level,
  flag: kRotates | kMoves | (bone.ik ? kSolves : 0) | (bone.append ? kAppendsTurn : 0) |
      (bone.axis ? kOneAxis : 0),
  appendTransform: bone.append && {parentIndex: bone.append.bone, ratio: bone.append.share},
  axisLimit: bone.axis,
  ik: bone.ik && {
    target: bone.ik.target,
    iteration: bone.ik.rounds,
    rotationConstraint: bone.ik.step,
    links: bone.ik.links.map(
        (link) => ({target: link.bone, limitation: link.knee ? kneeLimits : undefined})),
  },
}));

const scene = new Scene(new NullEngine());
const bones = body.bones.map((bone) => new PlainBone(bone.name, bone.rest));
const mesh = {
  name: 'body',
  metadata: {
    isMmdSkinnedMesh: true,
    header: {}, meshes: [], materials: [], morphs: [], rigidBodies: [], joints: [],
    bones: metadata,
    skeleton: {bones, _markAsDirty() {}},
  },
};
const runtime = new MmdRuntime(scene);
const model = runtime.createMmdModelFromSkeleton(
    mesh, {bones, prepare() {}}, {materialProxyConstructor: null, buildPhysics: false});
const bytes = fs.readFileSync(motionFile);
const motion = await new VmdLoader(scene).loadFromBufferAsync(
    'motion', bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
model.setRuntimeAnimation(model.createRuntimeAnimation(motion));

let compared = 0;
let worst = 0;
let where = '';
const place = new Vector3();
for (const {frame, places} of body.frames) {
  runtime.seekAnimation(frame, true);
  runtime.beforePhysics(0);
  runtime.afterPhysics();
  places.forEach((ours, i) => {
    model.runtimeBones[i].getWorldTranslationToRef(place);
    const distance = place.subtract(Vector3.FromArray(ours)).length();
    ++compared;
    if (!(distance <= worst)) {
      worst = distance;
      where = `${body.bones[i].name} of frame ${frame}`;
    }
  });
}
process.stdout.write(JSON.stringify({compared, worst, where, duration: motion.endFrame}) + '\n');
