// Draws a picture from Node by koffi: koffi_test.js KOFFI LIBRARY SCENE
'use strict';
const [koffi_folder, library, scene] = process.argv.slice(2);
const koffi = require(koffi_folder);
const swell = koffi.load(library);

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
const hash_of = swell.func('int swell_picture_hash(swell_picture *picture, _Out_ uint64 *hash)');
const destroy = {
  world: swell.func('void swell_world_destroy(swell_world *world)'),
  session: swell.func('void swell_session_destroy(swell_session *session)'),
  picture: swell.func('void swell_picture_destroy(swell_picture *picture)'),
};

// What a function gives by its last argument.
function given(call) {
  const out = [null];
  if (call(out) !== 0) throw new Error(last_error());
  return out[0];
}

const world = given(out => load(scene, out));
const session = given(out => open(world, 2, out));
const picture = given(out => create(out));
const frame = {size: koffi.sizeof(Frame), t_s: 5, width_px: 64, height_px: 36, camera: null, labels: null};
if (render(session, frame, picture) !== 0) throw new Error(last_error());
const hash = given(out => hash_of(picture, out));
destroy.picture(picture);
destroy.session(session);
destroy.world(world);
console.log(`frame 0 xxh3 ${BigInt(hash).toString(16).padStart(16, '0')}`);
