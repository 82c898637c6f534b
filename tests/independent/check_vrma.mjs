// node check_vrma.mjs CLIP.vrma MODEL.vrm OURS.tsv: what pixiv's three-vrm-animation makes of a
// clip on a model, against the joints that `raks avatar pose` wrote. One JSON line on stdout:
// errors and warnings of gltf-validator, joints compared, the largest distance in metres.
// Textures are left out.
import fs from 'node:fs';
import * as THREE from 'three';
import {GLTFLoader} from 'three/examples/jsm/loaders/GLTFLoader.js';
import {VRMHumanBoneParentMap, VRMLoaderPlugin, VRMUtils} from '@pixiv/three-vrm';
import {VRMAnimationLoaderPlugin} from '@pixiv/three-vrm-animation';
import validator from 'gltf-validator';

globalThis.self = globalThis;
console.warn = () => {};

async function load(file) {
  const bytes = fs.readFileSync(file);
  const loader = new GLTFLoader();
  loader.register((parser) => {
    parser.loadTextureImage = async () => new THREE.Texture();
    parser.loadImageSource = async () => new THREE.Texture();
    return {name: 'no_textures'};
  });
  loader.register((parser) => new VRMLoaderPlugin(parser));
  loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  return new Promise((done, failed) => loader.parse(buffer, '', done, failed));
}

// frame -> node -> [x, y, z]
function readTable(file) {
  const frames = new Map();
  for (const line of fs.readFileSync(file, 'utf8').trim().split('\n').slice(1)) {
    const [frame, node, , x, y, z] = line.split('\t');
    if (!frames.has(Number(frame))) frames.set(Number(frame), new Map());
    frames.get(Number(frame)).set(Number(node), [x, y, z].map(Number));
  }
  return frames;
}

const [clipFile, modelFile, tableFile] = process.argv.slice(2);
const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(clipFile)));
const gltf = await load(modelFile);
const vrm = gltf.userData.vrm;
VRMUtils.rotateVRM0(vrm);
const animation = (await load(clipFile)).userData.vrmAnimations[0];
const flips = vrm.meta.metaVersion === '0';  // 0.x faces -z: x and z are turned

function rotationAt(bone, seconds) {
  const track = animation.humanoidTracks.rotation.get(bone);
  return track ? new THREE.Quaternion().fromArray(track.createInterpolant().evaluate(seconds))
               : new THREE.Quaternion();
}

const has = (bone) => Boolean(vrm.humanoid.getRawBoneNode(bone));

// Rotations of bones that the model lacks go into the next ones that it has, as the specification
// of VRMA recommends; three-vrm's own clips leave them out.
function poseAt(seconds) {
  for (const bone of Object.keys(vrm.humanoid.humanBones)) {
    if (!has(bone)) continue;
    const q = rotationAt(bone, seconds);
    for (let up = VRMHumanBoneParentMap[bone]; up && !has(up); up = VRMHumanBoneParentMap[up]) {
      q.premultiply(rotationAt(up, seconds));
    }
    vrm.humanoid.getNormalizedBoneNode(bone).quaternion.set(
        flips ? -q.x : q.x, q.y, flips ? -q.z : q.z, q.w);
  }
  const travel = animation.humanoidTracks.translation.get('hips');
  const scale = vrm.humanoid.normalizedRestPose.hips.position[1] / animation.restHipsPosition.y;
  const [x, y, z] = travel.createInterpolant().evaluate(seconds);
  vrm.humanoid.getNormalizedBoneNode('hips').position.set(
      (flips ? -x : x) * scale, y * scale, (flips ? -z : z) * scale);
}

const nodeOf = (bone) => gltf.parser.associations.get(vrm.humanoid.getRawBoneNode(bone)).nodes;
const frames = readTable(tableFile);
let compared = 0;
let worst = 0;
let where = '';
const place = new THREE.Vector3();
const rate = 60;
for (const [frame, nodes] of frames) {
  if (frame % 7 !== 0) continue;
  poseAt(frame / rate);
  vrm.humanoid.update();
  vrm.nodeConstraintManager?.update();
  vrm.scene.updateMatrixWorld(true);
  for (const bone of Object.keys(vrm.humanoid.humanBones)) {
    const joint = vrm.humanoid.getRawBoneNode(bone);
    const ours = joint && nodes.get(nodeOf(bone));
    if (!ours) continue;
    joint.getWorldPosition(place);
    const distance = place.distanceTo(new THREE.Vector3(...ours));
    ++compared;
    if (!(distance <= worst)) {
      worst = distance;
      where = `${bone} of frame ${frame}`;
    }
  }
}
console.log(JSON.stringify({
  errors: report.issues.numErrors,
  warnings: report.issues.numWarnings,
  messages: report.issues.messages.slice(0, 5).map((message) => `${message.code} ${message.pointer}`),
  duration: animation.duration,
  frames: frames.size,
  compared,
  worst,
  where,
}));
