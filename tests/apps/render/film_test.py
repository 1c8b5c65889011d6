"""Films of swell-render as ROS 2 messages, read from their public descriptions: film_test.py BIN SOURCE [CASE ...]."""
import collections
import math
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

BIN, SOURCE = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "tests/apps/sim"))
import mcap_reader  # noqa: E402

WIDTH, HEIGHT = 64, 36
SCENE = """
[sky]
model = "gradient"
[sea]
resolution = 32
[detail]
water_triangles = 500
[camera]
eye_m = [1, 2, 4]
heading_deg = 90
pitch_deg = -10
fov_y_deg = 50
[[object]]
kind = "sphere"
name = "ball"
position_m = [20, 2]
class = "buoy"
"""
RIG = f"""
[[camera]]
name = "camera"
position_m = [0, 0, 4]
width_px = {WIDTH}
height_px = {HEIGHT}
depth = true
class = true
id = true
"""
# {label: (encoding, bytes a pixel)}
LABELS = {"depth": ("32FC1", 4), "distance": ("32FC1", 4), "position": ("32FC3", 12), "normal": ("32FC3", 12),
          "geometric_normal": ("32FC3", 12), "id": ("32SC1", 4), "class": ("16UC1", 2), "motion": ("32FC2", 8),
          "elevation": ("32FC1", 4), "foam": ("32FC1", 4), "flags": ("8UC1", 1)}


class Film(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.scene, self.film = self.folder / "sea.toml", self.folder / "film.mcap"
        self.partial = self.folder / "film.mcap.partial"
        self.scene.write_text(SCENE)

    def command(self, *arguments):
        return [str(word) for word in (BIN / "swell-render", "--scene", self.scene, "--size", f"{WIDTH}x{HEIGHT}",
                                       *arguments)]

    def render(self, *arguments, **more):
        return subprocess.run(self.command(*arguments), capture_output=True, check=False, **more)

    def topics(self, *arguments):
        """{topic: [values]} of a film, each with its time as t_ns."""
        done = self.render("--out", self.film, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertFalse(self.partial.exists())
        recording = mcap_reader.read(self.film)
        self.assertTrue(recording.is_whole)
        topics = collections.defaultdict(list)
        for message in recording.messages:
            topics[message.topic].append({**message.values, "t_ns": message.t_ns})
        return topics

    def test_has_the_frames_that_other_files_have(self):
        numbered = "%d.npy"
        topics = self.topics("--frames", "3-12", "--every", 3, "--fps", 25, "--labels", "depth,id", "--depth",
                             self.folder / ("depth" + numbered), "--ids", self.folder / ("id" + numbered))
        pictures = self.render("--frames", "3-12", "--every", 3, "--fps", 25, "--stream", "ppm").stdout
        frames = [3, 6, 9, 12]
        self.assertEqual({topic: len(messages) for topic, messages in topics.items()}, dict.fromkeys(
            ("/tf", "/camera/image_raw", "/camera/camera_info", "/camera/depth", "/camera/id"), len(frames)))
        size = len(pictures) // len(frames)
        for n, frame in enumerate(frames):
            t_ns = frame * 40_000_000
            for topic in ("image_raw", "camera_info", "depth", "id"):
                message = topics["/camera/" + topic][n]
                self.assertEqual(message["t_ns"], t_ns)
                self.assertEqual(message["header"], {"stamp": {"sec": 0, "nanosec": t_ns},
                                                     "frame_id": "camera_optical_frame"})
                self.assertEqual((message["width"], message["height"]), (WIDTH, HEIGHT))
            picture = pictures[n * size:(n + 1) * size]
            self.assertEqual(topics["/camera/image_raw"][n]["data"], picture[-3 * WIDTH * HEIGHT:])
            for label in ("depth", "id"):
                array = (self.folder / f"{label}{frame}.npy").read_bytes()
                self.assertEqual(topics["/camera/" + label][n]["data"], array[-4 * WIDTH * HEIGHT:])

    def test_says_where_the_camera_is_and_what_it_sees(self):
        topics = self.topics("--time", 2.5)
        info, = topics["/camera/camera_info"]
        focal_px = 0.5 * HEIGHT / math.tan(math.radians(25.0))
        self.assertEqual((info["distortion_model"], info["d"]), ("plumb_bob", [0.0] * 5))
        for value, expected in zip(info["k"], (focal_px, 0, WIDTH / 2 - 0.5, 0, focal_px, HEIGHT / 2 - 0.5, 0, 0, 1)):
            self.assertAlmostEqual(value, expected, delta=1e-5)
        moved, = topics["/tf"][0]["transforms"]
        self.assertEqual(topics["/tf"][0]["t_ns"], 2_500_000_000)
        self.assertEqual((moved["header"]["frame_id"], moved["child_frame_id"]), ("map", "camera_optical_frame"))
        self.assertEqual(moved["transform"]["translation"], {"x": 1.0, "y": 2.0, "z": 4.0})
        x, y, z, w = (moved["transform"]["rotation"][axis] for axis in "xyzw")
        ahead = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))  # where the frame's z points
        pitch = math.radians(-10.0)
        for value, expected in zip(ahead, (math.cos(pitch), 0.0, math.sin(pitch))):  # to the east, and down
            self.assertAlmostEqual(value, expected, delta=1e-6)

    def test_tells_the_models_of_wide_cameras(self):
        fisheye = self.topics("--set", "camera.projection=fisheye", "--set", "camera.fisheye_fov_deg=180", "--set",
                              "camera.fisheye_k=[0.02, -0.003, 0, 0]")["/camera/camera_info"][0]
        half = 0.5 * math.pi
        self.assertEqual((fisheye["distortion_model"], fisheye["d"]), ("equidistant", [0.02, -0.003, 0.0, 0.0]))
        self.assertAlmostEqual(fisheye["k"][0], 0.5 * HEIGHT / (half * (1 + 0.02 * half**2 - 0.003 * half**4)), 6)
        everywhere = self.topics("--set", "camera.projection=equirectangular")["/camera/camera_info"][0]
        self.assertEqual((everywhere["distortion_model"], everywhere["d"], any(everywhere["k"])),
                         ("equirectangular", [], False))

    def test_has_the_topics_that_a_camera_of_swell_sim_has(self):
        topics = self.topics("--labels", "depth,class,id")
        rig = self.folder / "rig.toml"
        rig.write_text(RIG)
        subprocess.run([BIN / "swell-sim", "--scene", self.scene, "--rig", rig, "--duration", "0.01", "--record",
                        self.folder / "run.mcap"], check=True, stdout=subprocess.DEVNULL)
        recorded = {message.topic: (message.type, message.values) for message in
                    mcap_reader.read(self.folder / "run.mcap").messages if message.topic.startswith("/camera/")}
        filmed = {message.topic: (message.type, message.values) for message in
                  mcap_reader.read(self.film).messages if message.topic.startswith("/camera/")}
        self.assertEqual(len(topics["/camera/class"]), 1)

        def heads(messages):
            return {topic: (kind, values["header"], values.get("encoding"), values.get("step"))
                    for topic, (kind, values) in messages.items()}
        self.assertEqual(heads(filmed), heads(recorded))

    def test_holds_every_label(self):
        topics = self.topics("--labels", "all")
        image = {label: topics[f"/camera/{label}"][0] for label in LABELS}
        for label, (encoding, pixel_bytes) in LABELS.items():
            self.assertEqual((label, image[label]["encoding"], image[label]["step"], len(image[label]["data"])),
                             (label, encoding, pixel_bytes * WIDTH, pixel_bytes * WIDTH * HEIGHT))

        def values(label, kind, count=1):
            flat = struct.unpack(f"<{count * WIDTH * HEIGHT}{kind}", image[label]["data"])
            return flat if count == 1 else list(zip(*(flat[c::count] for c in range(count))))
        ids, classes = values("id", "i"), values("class", "H")
        self.assertEqual(set(zip(ids, classes)) - {(1, 4)}, {(0, 0), (1, 1), (16, 5)})  # sky, sea, ball; 4 is foam
        seen = [i for i, number in enumerate(ids) if number > 0]
        depth, distance, position = values("depth", "f"), values("distance", "f"), values("position", "f", 3)
        normal, motion = values("normal", "f", 3), values("motion", "f", 2)
        for i in seen:
            away = math.dist(position[i], (1.0, 2.0, 4.0))
            self.assertAlmostEqual(distance[i], away, delta=1e-5 * away)
            self.assertLess(depth[i], distance[i] * (1 + 1e-6))
            self.assertAlmostEqual(math.hypot(*normal[i]), 1.0, 4)
            self.assertLess(math.hypot(*motion[i]), 10.0)
        self.assertTrue(math.isinf(depth[ids.index(0)]))

    def test_leaves_labels_to_a_file_that_is_named_for_them(self):
        topics = self.topics("--labels", "depth", "--labels-out", self.folder / "labels.exr")
        self.assertNotIn("/camera/depth", topics)
        self.assertTrue((self.folder / "labels.exr").exists())
        self.assertTrue((self.folder / "labels.labels.json").exists())

    def test_has_the_same_bytes_with_any_number_of_threads(self):
        films = []
        for threads in (1, 2, 2):
            self.topics("--frames", "0-9", "--labels", "all", "--threads", threads)
            films.append(self.film.read_bytes())
        self.assertTrue(films[0] == films[1])
        self.assertTrue(films[0] == films[2])

    def test_that_is_killed_leaves_all_whole_chunks(self):
        whole = [values["data"] for values in self.topics("--frames", "0-199")["/camera/image_raw"]]
        self.film.unlink()
        with subprocess.Popen(self.command("--frames", "0-100000", "--out", self.film)) as process:
            while not self.partial.exists() or self.partial.stat().st_size < 500_000:
                self.assertIsNone(process.poll())
                time.sleep(0.005)
            process.send_signal(signal.SIGKILL)
        self.assertFalse(self.film.exists())
        found = mcap_reader.read(self.partial)
        self.assertFalse(found.is_whole)
        self.assertGreater(found.chunks, 0)
        pictures = [message.values["data"] for message in found.messages if message.topic == "/camera/image_raw"]
        self.assertGreater(len(pictures), 100)
        self.assertTrue(pictures[:200] == whole[:len(pictures)])

    def test_without_room_ends_with_a_line_and_its_whole_chunks(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, 1 << 20))
        done = self.render("--frames", "0-2000", "--out", self.film, preexec_fn=limit)
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        self.assertEqual(done.stderr.decode(), f"error: {self.partial}: File too large\n")
        self.assertFalse(self.film.exists())
        found = mcap_reader.read(self.partial)
        self.assertGreater(found.chunks, 0)
        self.assertFalse(found.is_whole)

    def test_that_cannot_be_is_one_line(self):
        for arguments, words in ((("--out", "f%d.mcap", "--frames", "0-2"), "allowed .mcap files without %d"),
                                 (("--out", "f.mcap", "--time", "-1"), "got a frame at -1 s, allowed 0 to 2147483647"),
                                 (("--out", "f.mcap", "--time", "3e9"), "got a frame at 3000000000 s"),
                                 (("--out", "f.mcap", "--frames", "0-2", "--skip-existing"), "--skip-existing, got it"),
                                 (("--out", "no/f.mcap"), "got a folder that is not there"),
                                 (("--out", "f.mcap", "--depth", "f.mcap"), "another file than --out")):
            done = self.render(*arguments, cwd=self.folder, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertTrue(done.stderr.startswith("error: "))
            self.assertIn(words, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [self.scene])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
