"""swell-sim's topics of ROS 2 over DDS, seen from another process: dds_test.py BIN SOURCE PEER [CASE ...].

PEER (dds_peer.cpp) knows the messages by their public definitions alone. SWELL_DDS_SUBSCRIBERS: how many come and go
(200).
"""
import json
import os
import pathlib
import queue
import random
import re
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "sim"))
import mcap_reader  # noqa: E402

BIN, SOURCE, PEER = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
SCENE, RIG = SOURCE / "scenes/harbour.toml", SOURCE / "scenes/rigs/harbour_boat.toml"
SMALL = ("--rig-set", "camera[0].width_px=160", "--rig-set", "camera[0].height_px=90")
MS = 10**6

SEA = """
[sky]
model = "gradient"
[sea]
resolution = 32
[detail]
water_triangles = 500
"""
BOAT = """
[[body]]
frame = "boat"
pose = "input"
[[pose]]
name = "tip"
body = "boat"
position_m = [1, 0, 0]
rate_hz = 100
[[imu]]
name = "imu"
body = "boat"
[[odometry]]
name = "odom"
body = "boat"
[[wave_probe]]
name = "probe"
body = "boat"
rate_hz = 20
[[camera]]
name = "camera"
body = "boat"
position_m = [0, 0, 3]
width_px = 64
height_px = 36
rate_hz = 10
"""


def environment(**more):
    """Of this process, with nothing of ROS or DDS but what is given; a domain of this test's own."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "CYCLONEDDS"))}
    return {**kept, "ROS_DOMAIN_ID": str(100 + os.getpid() % 100), **more}


def values(value):
    """A message's values as message_values.h has them."""
    if isinstance(value, dict):
        return b"".join(map(values, value.values()))
    if isinstance(value, list):
        return b"".join(map(values, value))
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    return value.encode() if isinstance(value, str) else struct.pack("<d", float(value))


def line(message):
    """As the peer prints it."""
    said = values(message.values)
    head = message.values.get("header") or (message.values.get("transforms") or [{}])[0].get("header")
    stamp = head["stamp"] if head else message.values["clock"]
    return (f"{message.topic} {message.type} {stamp['sec'] * 10**9 + stamp['nanosec']} {len(said)} "
            f"{zlib.crc32(said)}")


class Lines:
    """What a process prints, line by line."""

    def __init__(self, process):
        self.process = process
        self.all = []
        self.queue = queue.Queue()
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        for text in self.process.stdout:
            self.all.append(text.rstrip("\n"))
            self.queue.put(self.all[-1])

    def wait_for(self, pattern, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if re.match(pattern, self.queue.get(timeout=0.1)):
                    return
            except queue.Empty:
                pass
        raise AssertionError(f"no line like {pattern!r}")

    def finish(self):
        self.process.stdin.close()
        self.process.wait(60)
        self.thread.join()
        self.process.stdout.close()
        return self.all


class Dds(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.scene, self.rig = self.folder / "sea.toml", self.folder / "boat.toml"
        self.scene.write_text(SEA)
        self.rig.write_text(BOAT)

    def start(self, *arguments, env=None, **more):
        process = subprocess.Popen([str(argument) for argument in arguments], env=env or environment(), text=True,
                                   **more)
        self.addCleanup(process.kill)
        return process

    def peer(self, *arguments, env=None):
        return Lines(self.start(PEER, *arguments, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE))

    def sim(self, *arguments, env=None, scene=None, rig=None):
        return self.start(BIN / "swell-sim", "--scene", scene or self.scene, "--rig", rig or self.rig, "--dds", "on",
                          *arguments, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def finish(self, sim):
        out, said = sim.communicate(timeout=120)
        self.assertEqual(sim.returncode, 0, said)
        self.assertNotIn("warning", said)
        return out

    @staticmethod
    def tick(sim, t_ns):
        sim.stdin.write(json.dumps({"clock_ns": t_ns}) + "\n")
        sim.stdin.flush()

    def topics_of(self, recording):
        """TOPIC=TYPE of all messages of a recording."""
        return sorted({f"{message.topic}={message.type}" for message in mcap_reader.read(recording).messages})

    def test_a_foreign_reader_gets_what_a_recording_has(self):
        probe = self.folder / "probe.mcap"
        pictures = (*SMALL, "--rig-set", "camera[0].compressed=jpeg")
        subprocess.run([BIN / "swell-sim", "--scene", SCENE, "--rig", RIG, *pictures, "--record", probe, "--duration",
                        "0.01", "--rig-set", "clock_hz=0"], check=True, stdout=subprocess.DEVNULL)
        topics = self.topics_of(probe)
        self.assertEqual(len(topics), 16)
        self.assertIn("/camera/image_raw/compressed=sensor_msgs/msg/CompressedImage", topics)
        reader = self.peer("read", *topics)
        reader.wait_for("ready")
        path = self.folder / "run.mcap"
        sim = self.sim(*pictures, "--clock", "input", "--inputs", "-", "--record", path, scene=SCENE, rig=RIG)
        # Until all have found each other; what was published before is lost to volatile readers.
        t_ns = 0
        waiting = {topic.split("=")[0] for topic in topics}
        end = time.monotonic() + 120
        while waiting:
            self.assertLess(time.monotonic(), end, f"nothing of {waiting}")
            self.tick(sim, t_ns)
            t_ns += 50 * MS
            time.sleep(0.05)
            waiting -= {text.split()[0] for text in list(reader.all)}
        first_ns = t_ns
        for t_ns in range(first_ns, first_ns + 10 * 10**9, 10 * MS):
            self.tick(sim, t_ns)
        self.finish(sim)
        time.sleep(0.5)

        def after(lines):
            return sorted(text for text in lines if int(text.split()[2]) >= first_ns)
        lines = reader.finish()
        got = after(text for text in lines if text.startswith("/"))
        recorded = after(map(line, mcap_reader.read(path).messages))
        self.assertEqual(len(recorded), 5600)
        self.assertEqual(got, recorded)
        self.assertEqual(sum(text.startswith("/tf_static ") for text in lines), 1)

    def test_who_comes_late_gets_the_static_frames(self):
        sim = self.sim("--duration", "60")
        time.sleep(2)
        reader = self.peer("read", "/tf_static=tf2_msgs/msg/TFMessage")
        reader.wait_for("/tf_static tf2_msgs/msg/TFMessage 0 ")
        sim.terminate()
        self.finish(sim)
        reader.finish()

    def test_other_nodes_are_told_of_the_node_and_its_endpoints(self):
        sim = self.sim("--duration", "60", "--rig-set", "clock_hz=10")
        time.sleep(2)
        peer = self.start(PEER, "nodes", "/swell_sim", stdout=subprocess.PIPE)
        told, _ = peer.communicate(timeout=90)
        self.assertEqual(peer.returncode, 0)
        sim.terminate()
        self.finish(sim)
        topics = ("camera/camera_info", "camera/image_raw", "clock", "imu/data", "odom", "probe", "tf", "tf_static",
                  "tip")
        self.assertEqual(sorted(told.splitlines()),
                         ["hears rt/boat/pose", *(f"publishes rt/{topic}" for topic in topics)])

    def test_lock_step_with_another_process_is_the_same_each_time(self):
        recordings = []
        for threads in (1, 2, 2):
            path = self.folder / f"{len(recordings)}.mcap"
            sim = self.sim("--clock", "input", "--record", path, "--threads", threads)
            driver = self.start(PEER, "drive", "/boat/pose", "/tip", "100", "10")
            self.assertEqual(driver.wait(120), 0)
            sim.terminate()
            self.finish(sim)
            recordings.append(path.read_bytes())
        self.assertGreater(len(recordings[0]), 10000)
        self.assertTrue(recordings[0] == recordings[1])
        self.assertTrue(recordings[0] == recordings[2])
        self.assertTrue(recordings[0] == self.driven_by_lines(100))

    def test_a_pose_that_others_hear_too_is_there_before_its_clock(self):
        # To several readers Cyclone sends by multicast, which overtakes and is overtaken.
        others = [self.peer("read", "/boat/pose=geometry_msgs/msg/PoseStamped") for _ in range(2)]
        for other in others:
            other.wait_for("ready")
        path = self.folder / "heard.mcap"
        sim = self.sim("--clock", "input", "--record", path)
        driver = self.start(PEER, "drive", "/boat/pose", "/tip", "1000", "10")
        self.assertEqual(driver.wait(300), 0)
        sim.terminate()
        self.finish(sim)
        for other in others:
            self.assertEqual(len({text.split()[2] for text in other.finish()[1:]}), 1000)
        self.assertTrue(path.read_bytes() == self.driven_by_lines(1000))

    def driven_by_lines(self, steps):
        """The recording of what PEER drives, from lines of JSON."""
        lines = [json.dumps(row) for k in range(steps) for row in (
            {"body": "boat", "stamp_ns": k * 10 * MS, "position": [1e-3 * 10 * k, 2 - 1e-3 * k, 1],
             "orientation": [0, 0, 0.6, 0.8]}, {"clock_ns": k * 10 * MS})]
        path = self.folder / "lines.mcap"
        subprocess.run([BIN / "swell-sim", "--scene", self.scene, "--rig", self.rig, "--clock", "input", "--inputs", "-",
                        "--record", path], input="\n".join(lines), text=True, check=True, stdout=subprocess.DEVNULL)
        return path.read_bytes()

    def test_in_real_time_no_stamp_is_left_out_while_subscribers_come_and_go(self):
        count = os.environ.get("SWELL_DDS_SUBSCRIBERS", "200")
        rig = self.folder / "probe.toml"
        rig.write_text(BOAT.replace('pose = "input"', "position_m = [0, 0, 0]"))
        path = self.folder / "run.mcap"
        sim = self.sim("--record", path, "--measure", rig=rig)
        churn = self.start(PEER, "churn", count, "/camera/image_raw=sensor_msgs/msg/Image",
                           "/probe=geometry_msgs/msg/PointStamped", "/imu/data=sensor_msgs/msg/Imu",
                           "/tf_static=tf2_msgs/msg/TFMessage")
        self.assertEqual(churn.wait(500), 0)
        stopped = self.start(PEER, "read", "/camera/image_raw=sensor_msgs/msg/Image", stdin=subprocess.PIPE,
                             stdout=subprocess.DEVNULL)
        time.sleep(1)
        stopped.send_signal(19)  # SIGSTOP: it takes nothing more
        time.sleep(2)
        sim.terminate()
        out = self.finish(sim)
        late = re.search(r"99 % of messages within ([0-9.]+) ms", out)
        self.assertIsNotNone(late, out)
        self.assertLess(float(late.group(1)), 1000)  # other tests may run beside it
        stopped.kill()
        stopped.communicate()
        stamps = [message.t_ns for message in mcap_reader.read(path).messages if message.topic == "/imu/data"]
        self.assertGreater(len(stamps), 100)
        self.assertEqual(stamps, [10 * MS * k for k in range(len(stamps))])

    def test_what_the_environment_asks_for_is_obeyed_or_refused_by_a_line(self):
        for name, value, words in (("ROS_DOMAIN_ID", "x", "allowed 0 to 232"), ("ROS_DOMAIN_ID", "233", "allowed 0"),
                                   ("ROS_LOCALHOST_ONLY", "yes", "allowed 0 or 1"),
                                   ("ROS_AUTOMATIC_DISCOVERY_RANGE", "ALL", "allowed OFF, LOCALHOST"),
                                   ("ROS_STATIC_PEERS", "a<b", "allowed names or addresses"),
                                   ("CYCLONEDDS_URI", "<Foo/>", "unknown element"),
                                   ("CYCLONEDDS_URI", "/no/file", "can't open")):
            sim = self.sim("--duration", "0.1", env=environment(**{name: value}))
            _, said = sim.communicate(timeout=60)
            self.assertEqual(sim.returncode, 2, said)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertTrue(said.startswith(f"error: {name}: "), said)
            self.assertIn(words, said)
        for more, words in (({}, "by this machine and what is found through "),
                            ({"ROS_LOCALHOST_ONLY": "1"}, "by this machine alone, through lo (127.0.0.1)"),
                            ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, "by nobody (discovery is off)")):
            env = environment(**more)
            sim = self.sim("--duration", "0.1", "--rig-set", "body[0].pose=rig", "--rig-set",
                           "body[0].position_m=[0, 0, 0]", env=env)
            _, said = sim.communicate(timeout=60)
            self.assertEqual(sim.returncode, 0, said)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertIn(f"note: ROS 2 over DDS, domain {env['ROS_DOMAIN_ID']}: heard {words}", said)

    def test_ten_thousand_damaged_packets_are_told_of_in_one_line(self):
        env = environment(ROS_LOCALHOST_ONLY="1")
        rig = self.folder / "probe.toml"
        rig.write_text("[[wave_probe]]\nname = \"probe\"\n")
        sim = self.sim("--duration", "4", env=env, rig=rig)
        for text in sim.stderr:
            if "ROS 2 over DDS" in text:
                break
        choice = random.Random(4)
        head = b"RTPS\x02\x01\x01\x10" + bytes(12)
        kinds = (0x06, 0x07, 0x08, 0x09, 0x0e, 0x15, 0x16)  # of submessages
        port = 7400 + 250 * int(env["ROS_DOMAIN_ID"]) + 10  # discovery of the first on a machine; then its data
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for n in range(10000):
                body = choice.randbytes(choice.randrange(4, 200))
                if n % 2:
                    body = bytes((choice.choice(kinds), 5, body[2], 0)) + body[4:]
                sender.sendto(head + body, ("127.0.0.1", port + n // 2 % 2))
                if n % 100 == 0:
                    time.sleep(0.002)
        out, said = sim.communicate(timeout=60)
        self.assertEqual((sim.returncode, out), (0, ""))
        self.assertEqual(said.count("\n"), 1, said)
        self.assertTrue(said.startswith("warning: DDS: "), said)

    @unittest.skipUnless(shutil.which("unshare") and shutil.which("ip"), "no unshare, no ip")
    def test_on_this_machine_alone_no_packet_leaves_the_loopback(self):
        script = SOURCE / "tests/apps/dds/loopback_test.sh"
        done = subprocess.run([script, BIN, PEER, self.scene, self.rig], env=environment(), capture_output=True,
                              text=True, check=False)
        if done.returncode == 77:
            self.skipTest(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
