// Draws a scene from Rust by the C interface:
//   rustc -L PREFIX/lib -C link-arg=-Wl,-rpath,PREFIX/lib look.rs && ./look SCENE.toml
use std::ffi::{c_char, c_int, c_void, CStr, CString};
use std::ptr::{null, null_mut};

// The beginning of swell_frame: the library takes structures of fewer members.
#[repr(C)]
struct Frame {
    size: usize,
    t_s: f64,
    width_px: i32,
    height_px: i32,
    camera: *const c_void,
    labels: *const c_char,
}

#[repr(C)]
struct Plane {
    size: usize,
    data: *const c_void,
    bytes: usize,
    kind: c_int,
    width_px: i32,
    height_px: i32,
    components: i32,
}

#[link(name = "swell")]
extern "C" {
    fn swell_last_error() -> *const c_char;
    fn swell_world_load(path: *const c_char, world: *mut *mut c_void) -> c_int;
    fn swell_world_destroy(world: *mut c_void);
    fn swell_session_create(world: *const c_void, threads: i32, session: *mut *mut c_void) -> c_int;
    fn swell_session_destroy(session: *mut c_void);
    fn swell_picture_create(picture: *mut *mut c_void) -> c_int;
    fn swell_picture_destroy(picture: *mut c_void);
    fn swell_render(session: *mut c_void, frame: *const Frame, picture: *mut c_void) -> c_int;
    fn swell_picture_plane(picture: *mut c_void, name: *const c_char, plane: *mut Plane) -> c_int;
    fn swell_picture_hash(picture: *const c_void, hash: *mut u64) -> c_int;
}

fn check(status: c_int) -> Result<(), String> {
    if status == 0 {
        return Ok(());
    }
    Err(unsafe { CStr::from_ptr(swell_last_error()) }.to_string_lossy().into_owned())
}

// A handle that is destroyed with it.
struct Owned {
    handle: *mut c_void,
    destroy: unsafe extern "C" fn(*mut c_void),
}

impl Drop for Owned {
    fn drop(&mut self) {
        unsafe { (self.destroy)(self.handle) }
    }
}

fn made(
    create: impl FnOnce(*mut *mut c_void) -> c_int,
    destroy: unsafe extern "C" fn(*mut c_void),
) -> Result<Owned, String> {
    let mut handle = null_mut();
    check(create(&mut handle))?;
    Ok(Owned { handle, destroy })
}

fn draw(path: &str) -> Result<(), String> {
    let path = CString::new(path).map_err(|e| e.to_string())?;
    let depth = CString::new("depth").map_err(|e| e.to_string())?;
    unsafe {
        let world = made(|w| swell_world_load(path.as_ptr(), w), swell_world_destroy)?;
        let session = made(|s| swell_session_create(world.handle, 2, s), swell_session_destroy)?;
        let picture = made(|p| swell_picture_create(p), swell_picture_destroy)?;
        let size = std::mem::size_of::<Frame>();
        let labels = depth.as_ptr();
        let frame = Frame { size, t_s: 5.0, width_px: 64, height_px: 36, camera: null(), labels };
        check(swell_render(session.handle, &frame, picture.handle))?;
        let mut plane: Plane = std::mem::zeroed();
        plane.size = std::mem::size_of::<Plane>();
        check(swell_picture_plane(picture.handle, depth.as_ptr(), &mut plane))?;
        let count = (plane.width_px * plane.height_px) as usize;
        let depth_m = std::slice::from_raw_parts(plane.data as *const f32, count);
        let mut hash = 0;
        check(swell_picture_hash(picture.handle, &mut hash))?;
        println!("frame 0 xxh3 {:016x}", hash);
        println!("{:.1} m ahead", depth_m[30 * 64 + 32]);
    }
    Ok(())
}

fn main() {
    let path = std::env::args().nth(1).unwrap_or("scenes/lagoon.toml".to_string());
    if let Err(text) = draw(&path) {
        eprintln!("{}", text);
        std::process::exit(1);
    }
}
