// Draws a scene from Node by the C interface: npm install koffi && node look.js SCENE.toml
'use strict';
const koffi = require('koffi');
const swell = koffi.load(process.env.SWELL_LIBRARY || 'libswell.so');

// The beginning of swell_frame: the library takes structures of fewer members.
const Frame = koffi.struct('swell_frame', {
  size: 'size_t', t_s: 'double', width_px: 'int32', height_px: 'int32', camera: 'void *', labels: 'str',
});
koffi.opaque('swell_world');
koffi.opaque('swell_session');
koffi.opaque('swell_picture');
const last_error = swell.func('const char *swell_last_error()');
const load = swell.func('int swell_world_load(str path, _Out_ swell_world **world)');
const open = swell.func('int swell_session_create(swell_world *world, int32 threads, _Out_ swell_session **session)');
const create = swell.func('int swell_picture_create(_Out_ swell_picture **picture)');
const render = swell.func('int swell_render(swell_session *session, swell_frame *frame, swell_picture *picture)');
const copy = swell.func('int swell_picture_copy(swell_picture *picture, str name, _Out_ float *buffer, size_t bytes)');
const hash_of = swell.func('int swell_picture_hash(swell_picture *picture, _Out_ uint64 *hash)');
const destroy = {
  world: swell.func('void swell_world_destroy(swell_world *world)'),
  session: swell.func('void swell_session_destroy(swell_session *session)'),
  picture: swell.func('void swell_picture_destroy(swell_picture *picture)'),
};

function check(status) {
  if (status !== 0) throw new Error(last_error());
}

// What a function gives by its last argument.
function given(call) {
  const out = [null];
  check(call(out));
  return out[0];
}

function draw(path) {
  const world = given(out => load(path, out));
  const session = given(out => open(world, 2, out));
  const picture = given(out => create(out));
  const frame = {size: koffi.sizeof(Frame), t_s: 5, width_px: 64, height_px: 36, camera: null, labels: 'depth'};
  check(render(session, frame, picture));
  const depth_m = new Float32Array(64 * 36);
  check(copy(picture, 'depth', depth_m, depth_m.byteLength));
  const hash = given(out => hash_of(picture, out));
  destroy.picture(picture);
  destroy.session(session);
  destroy.world(world);
  console.log(`frame 0 xxh3 ${BigInt(hash).toString(16).padStart(16, '0')}`);
  console.log(`${depth_m[30 * 64 + 32].toFixed(1)} m ahead`);
}

try {
  draw(process.argv[2] || 'scenes/lagoon.toml');
} catch (fault) {
  console.error(fault.message);
  process.exitCode = 1;
}
