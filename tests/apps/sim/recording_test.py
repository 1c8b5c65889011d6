"""Recordings of swell-sim, read from their public descriptions: recording_test.py BIN SOURCE [CASE ...].

SWELL_SIM_KILLS: how many runs are killed (6).
"""
import collections
import os
import pathlib
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import mcap_reader

BIN, SOURCE = (pathlib.Path(path) for path in sys.argv[1:3])
SCENE, RIG = SOURCE / "scenes/harbour.toml", SOURCE / "scenes/rigs/harbour_boat.toml"
WIDTH, HEIGHT = 96, 54
SMALL = ("--rig-set", f"camera[0].width_px={WIDTH}", "--rig-set", f"camera[0].height_px={HEIGHT}",
         "--rig-set", "lidar[0].columns=64")

SEA = """
[sky]
model = "gradient"
[sea]
resolution = 32
[detail]
water_triangles = 500
"""
KILLED_RIG = """
[[camera]]
name = "camera"
position_m = [0, 0, 4]
width_px = 160
height_px = 90
depth = true
rate_hz = 20
[[wave_probe]]
name = "probe"
rate_hz = 100
"""


def run(*arguments):
    return subprocess.run([BIN / "swell-sim", *map(str, arguments)], capture_output=True, text=True, check=False)


def values_by_topic(path):
    """{topic: [(stamp, values)]} of a recording."""
    topics = collections.defaultdict(list)
    for message in mcap_reader.read(path).messages:
        topics[message.topic].append((message.t_ns, message.values))
    return topics


class Recording(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def record(self, name, *more, scene=SCENE, rig=RIG):
        path = self.folder / name
        done = run("--scene", scene, "--rig", rig, "--record", path, *more)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertFalse(path.with_name(name + ".partial").exists())
        return path

    def rendered(self, folder, every):
        """(picture, depth) of every so many frames of what the boat's camera sees, by swell-render."""
        folder.mkdir()
        settings = ("mount=launch", "mount_offset_m=[0, 1.6, 1.9]", "eye_m=", "heading_deg=0", "pitch_deg=-5",
                    "fov_y_deg=56")
        drawn = subprocess.run(
            [BIN / "swell-render", "--scene", SCENE, *(word for s in settings for word in ("--set", "camera." + s)),
             "--size", f"{WIDTH}x{HEIGHT}", "--frames", "0-199", "--every", str(every), "--fps", "20",
             "--stream", "ppm", "--depth", folder / "%04d.npy"], capture_output=True, check=True).stdout
        size = 3 * WIDTH * HEIGHT
        head = len(drawn) // (200 // every) - size
        for n in range(200 // every):
            begin = n * (head + size)
            self.assertEqual(drawn[begin:begin + 2], b"P6")
            depth = (folder / f"{n * every:04}.npy").read_bytes()
            yield drawn[begin + head:begin + head + size], depth[-4 * WIDTH * HEIGHT:]

    def test_ten_seconds_of_the_harbour_have_all_messages_and_the_pictures_of_swell_render(self):
        recording = mcap_reader.read(self.record("run.mcap", *SMALL))
        self.assertTrue(recording.is_whole)
        counts = collections.Counter(message.topic for message in recording.messages)
        self.assertEqual(counts, {
            "/tf_static": 1, "/tf": 500, "/odom": 500, "/imu/data": 1000, "/gnss/fix": 100, "/clock": 1000,
            "/echo_sounder": 100, "/gauge": 100, "/bow_wave": 1000, "/buoy_wave": 1000, "/camera/image_raw": 200,
            "/camera/camera_info": 200, "/camera/depth": 200, "/camera/class": 200, "/camera/id": 200,
            "/lidar/points": 100})
        by_topic = collections.defaultdict(list)
        for message in recording.messages:
            by_topic[message.topic].append(message)
            header = message.values.get("header")
            if header:
                stamp = header["stamp"]
                self.assertEqual(stamp["sec"] * 10**9 + stamp["nanosec"], message.t_ns)
        for topic, messages in by_topic.items():
            period_ns = 10**10 // len(messages)
            self.assertEqual([message.t_ns for message in messages],
                             [k * period_ns if k else 0 for k in range(len(messages))], topic)
        self.assertEqual([message.t_ns for message in recording.messages],
                         sorted(message.t_ns for message in recording.messages))
        self.check_pictures(by_topic)
        self.check_motion(by_topic)

    def check_pictures(self, by_topic):
        for topic, encoding, size in (("image_raw", "rgb8", 3), ("depth", "32FC1", 4), ("class", "16UC1", 2),
                                      ("id", "32SC1", 4)):
            for message in by_topic[f"/camera/{topic}"]:
                image = message.values
                self.assertEqual((image["encoding"], image["step"], len(image["data"])),
                                 (encoding, size * WIDTH, size * WIDTH * HEIGHT))
        every = 20
        for n, (picture, depth) in enumerate(self.rendered(self.folder / "frames", every)):
            self.assertEqual(by_topic["/camera/image_raw"][n * every].values["data"], picture, n)
            self.assertEqual(by_topic["/camera/depth"][n * every].values["data"], depth, n)

    def check_motion(self, by_topic):
        """Odometry and IMU against differences of the poses on /tf."""
        poses = [message.values["transforms"][0]["transform"] for message in by_topic["/tf"]]
        for k in range(100, 400, 10):
            before, after = poses[k - 1]["translation"], poses[k + 1]["translation"]
            velocity = [(after[axis] - before[axis]) * 25.0 for axis in "xyz"]
            twist = by_topic["/odom"][k].values["twist"]["twist"]
            speed = sum(v * v for v in velocity) ** 0.5
            self.assertAlmostEqual(sum(twist["linear"][axis] ** 2 for axis in "xyz") ** 0.5, speed, delta=0.05 * speed)
            # Half the turn in 40 ms is the vector part of the quaternion between the two.
            p, q = (poses[k + n]["rotation"] for n in (-1, 1))
            yaw = p["w"] * q["z"] - p["z"] * q["w"] + p["y"] * q["x"] - p["x"] * q["y"]
            imu = by_topic["/imu/data"][2 * k].values
            self.assertAlmostEqual(imu["angular_velocity"]["z"], 2.0 * yaw / 0.04, delta=0.02)
            felt = sum(imu["linear_acceleration"][axis] ** 2 for axis in "xyz") ** 0.5
            self.assertTrue(5.0 < felt < 15.0, felt)

    def test_runs_on_any_number_of_threads_have_the_same_bytes(self):
        first, again, two = (self.record(f"{n}.mcap", *SMALL, "--duration", 1, "--threads", threads).read_bytes()
                             for n, threads in enumerate((1, 1, 2)))
        self.assertTrue(first == again)
        self.assertTrue(first == two)
        slow = self.record("slow.mcap", *SMALL, "--duration", 1, "--realtime").read_bytes()
        self.assertTrue(first == slow)

    def test_a_killed_run_leaves_all_whole_chunks(self):
        scene, rig = self.folder / "sea.toml", self.folder / "rig.toml"
        scene.write_text(SEA)
        rig.write_text(KILLED_RIG)
        reference = mcap_reader.read(self.record("whole.mcap", "--duration", 20, scene=scene, rig=rig)).messages
        choice = random.Random(3)
        with_chunks = 0
        for _ in range(int(os.environ.get("SWELL_SIM_KILLS", "6"))):
            path = self.folder / "killed.mcap"
            partial = path.with_name("killed.mcap.partial")
            partial.unlink(missing_ok=True)
            process = subprocess.Popen([BIN / "swell-sim", "--scene", scene, "--rig", rig, "--record", path,
                                        "--duration", "100000"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while not partial.exists() or partial.stat().st_size == 0:  # it is being made ready
                self.assertIsNone(process.poll())
                time.sleep(0.005)
            time.sleep(choice.uniform(0.0, 1.0))
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assertFalse(path.exists())
            found = mcap_reader.read(partial)
            self.assertFalse(found.is_whole)
            self.assertGreater(len(found.messages), 60 * (found.chunks - 1))
            both = min(len(found.messages), len(reference))
            self.assertEqual(found.messages[:both], reference[:both])
            with_chunks += found.chunks > 0
        self.assertGreater(with_chunks, 0)

    def test_a_lens_bends_the_picture_and_is_told_of(self):
        lens = "camera[0].distortion=[-0.25, 0.05, 0.001, -0.001, 0]"
        message = {m.topic: m.values for m in mcap_reader.read(
            self.record("lens.mcap", *SMALL, "--rig-set", lens, "--duration", 0.05)).messages}
        self.assertEqual(message["/camera/camera_info"]["d"], [-0.25, 0.05, 0.001, -0.001, 0.0])
        self.assertEqual(len(message["/camera/image_raw"]["data"]), 3 * WIDTH * HEIGHT)
        plain = {m.topic: m.values for m in mcap_reader.read(
            self.record("plain.mcap", *SMALL, "--duration", 0.05)).messages}
        depth, bent = (struct.unpack(f"<{WIDTH * HEIGHT}f", m["/camera/depth"]["data"]) for m in (plain, message))
        middle, corner = HEIGHT // 2 * WIDTH + WIDTH // 2, WIDTH * HEIGHT - 1
        self.assertAlmostEqual(bent[middle], depth[middle], delta=0.05 * depth[middle])
        self.assertLess(bent[corner], 0.99 * depth[corner])  # a barrel sees more of the water below

    def test_an_f_number_exposes_as_the_scenes_does(self):
        def picture(name, *arguments):
            recorded = self.record(name, *SMALL, "--set", "camera.exposure_s=0.01", *arguments, "--duration", 0.05)
            return {m.topic: m.values for m in mcap_reader.read(recorded).messages}["/camera/image_raw"]["data"]

        by_rig = picture("rig.mcap", "--rig-set", "camera[0].f_number=16")
        self.assertEqual(by_rig, picture("scene.mcap", "--set", "camera.f_number=16"))
        self.assertNotEqual(by_rig, picture("sky.mcap"))
        fast = picture("fast.mcap", "--rig-set", "camera[0].f_number=16", "--rig-set", "camera[0].iso=400")
        self.assertEqual(fast, picture("wide.mcap", "--rig-set", "camera[0].f_number=8"))

    def test_what_is_not_right_is_one_line(self):
        ok = ("--scene", SCENE, "--rig", RIG)
        rig = self.folder / "rig.toml"
        rig.write_text("[[camera]]\nname = \"c\"\nrate = 20\n")
        folded = "camera[0].distortion=[-5, 0, 0, 0, 0]"
        for arguments, words in (
                ((), "--scene, got none"), (("--scene", SCENE), "--rig, got none"), (ok, "got nothing to do"),
                ((*ok, "--measure", "--duration", "0"), "--duration: got '0'"),
                ((*ok, "--measure", "--duration", "nan"), "--duration: got 'nan'"),
                (("--scene", SCENE, "--rig", rig, "--measure"),
                 f"{rig}:3: column 1: unknown key, got 'camera[0].rate'"),
                (("--scene", SCENE, "--rig", self.folder, "--measure"), "rig, got a directory"),
                ((*ok, "--measure", "--set", "object[5].name="), "body[0].mount, got \"launch\""),
                ((*ok, "--measure", "--rig-set", folded), "camera[0].distortion, got one that folds"),
                ((*ok, "--measure", "--rig-set", "camera[0].f_number=8"),
                 "camera[0].f_number, got it in a scene without camera.exposure_s"),
                ((*ok, "--measure", "--rig-set", "camera[0].f_number=8", "--set", "camera.exposure_s=0.01", "--set",
                  "sky.zenith=[0.1, 0.2, 0.3]"), "camera[0].f_number, got it under a gradient"),
                ((*ok, "--record", self.folder / "no" / "run.mcap"), "got a folder that is not there"),
                ((*ok, "--record", self.folder), "got a directory")):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertTrue(done.stderr.startswith("error: "))
            self.assertIn(words, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [rig])

    def test_stamps_of_the_systems_clock_are_utc_and_their_messages_of_that_time(self):
        before = time.time_ns()
        live = self.record("live.mcap", *SMALL, "--clock", "system", "--duration", "0.3")
        topics = values_by_topic(live)
        self.assertNotIn("/clock", topics)
        stamps = sorted(stamp for stamp, _ in sum(topics.values(), []))
        self.assertGreater(stamps[0], before)
        self.assertLess(stamps[-1], time.time_ns())
        self.assertTrue(all(stamp % 10_000_000 == 0 for stamp, _ in topics["/bow_wave"]))
        self.assertIn(len(topics["/bow_wave"]), (29, 30, 31))
        # The same in lock-step with a clock that shows these times.
        lines = self.folder / "clock.jsonl"
        lines.write_text("".join(f'{{"clock_ns": {stamp}}}\n' for stamp in sorted(set(stamps))))
        again = self.record("again.mcap", *SMALL, "--clock", "input", "--inputs", lines)
        self.assertEqual(values_by_topic(again), topics)

    def test_measure_tells_what_each_sensor_costs(self):
        done = run("--scene", SCENE, "--rig", RIG, *SMALL, "--measure", "--duration", "0.2", "--realtime")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = {line.split()[0]: line.split()[1:] for line in done.stdout.splitlines()}
        self.assertEqual(rows["camera"][:2], ["camera", "4"])
        self.assertEqual(rows["imu"][:2], ["imu", "20"])
        self.assertGreater(float(rows["camera"][2]), 0.1)
        self.assertIn("of real time", done.stdout)
        self.assertIn("after their stamps", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
