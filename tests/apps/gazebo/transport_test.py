"""transport_test.py BIN SOURCE BUILD: what swell-sim publishes, takes and answers on Gazebo's transport, against its
recordings and the Python package. The other end is gazebo_peer, a process of its own; packets stay on the loopback."""
import base64
import codecs
import collections
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

BIN, SOURCE, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path[:0] = [str(SOURCE / "tests/apps/sim"), str(BUILD / "python")]
import mcap_reader  # noqa: E402

SCENE, RIG = SOURCE / "scenes/harbour.toml", SOURCE / "scenes/rigs/harbour_boat.toml"
WIDTH, HEIGHT = 96, 54
SMALL = ("--rig-set", f"camera[0].width_px={WIDTH}", "--rig-set", f"camera[0].height_px={HEIGHT}")
# {topic in the recording: (topic, type)}
TOPICS = {
    "/camera/image_raw": ("/camera/image", "Image"), "/camera/depth": ("/camera/depth_image", "Image"),
    "/camera/class": ("/camera/semantic/labels_map", "Image"), "/camera/id": ("/camera/panoptic/labels_map", "Image"),
    "/camera/camera_info": ("/camera/camera_info", "CameraInfo"), "/imu/data": ("/imu", "IMU"),
    "/gnss/fix": ("/gnss", "NavSat"), "/odom": ("/odom", "Odometry"), "/echo_sounder": ("/echo_sounder", "LaserScan"),
    "/gauge": ("/gauge", "LaserScan"), "/bow_wave": ("/bow_wave", "Vector3d"), "/buoy_wave": ("/buoy_wave", "Vector3d"),
    "/lidar/points": ("/lidar/points", "PointCloudPacked"), "/tf": ("/tf", "Pose_V"),
    "/tf_static": ("/tf_static", "Pose_V")}
COMMANDS = pathlib.Path("/usr/libexec/ignition/transport11")  # where Debian has what `ign topic` and `ign service` run


def environment(ip="127.0.0.1"):
    """Of a partition of the test's own, with queues that lose nothing."""
    names = {"IP": ip, "PARTITION": f"swell{os.getpid()}", "TRANSPORT_SNDHWM": "0", "TRANSPORT_RCVHWM": "0"}
    return {**os.environ, **{f"{prefix}_{name}": value for name, value in names.items() for prefix in ("IGN", "GZ")}}


class Process(subprocess.Popen):
    """With its lines; ends with the test."""

    def __init__(self, test, *command, ip="127.0.0.1", **options):
        super().__init__([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                         env=environment(ip), **options)
        test.addCleanup(self.close)

    def close(self):
        self.kill()
        self.wait()
        for pipe in (self.stdin, self.stdout, self.stderr):
            if pipe:
                pipe.close()

    def say(self, line):
        self.stdin.write(line + "\n")
        self.stdin.flush()

    def expect(self, test, text):
        line = self.stdout.readline()
        test.assertIn(text, line)
        return line


def sim(test, *arguments, **options):
    """A running swell-sim that has said who can hear it."""
    process = Process(test, BIN / "swell-sim", "--scene", SCENE, "--rig", RIG, "--gazebo", "on", *SMALL, *arguments,
                      stderr=subprocess.PIPE, **options)
    test.assertIn(f"gazebo: partition swell{os.getpid()} ", process.stderr.readline())
    return process


def clock_line(t_ns):
    return json.dumps({"clock_ns": t_ns})


# ---- What a message of a recording is on the transport, as JSON has it: what is zero is left out

def clean(value):
    """Without what is zero or empty; numbers as numbers."""
    if isinstance(value, dict):
        return {key: kept for key, one in value.items() if (kept := clean(one)) not in ({}, [], 0, "", False, None)}
    if isinstance(value, list):
        return [clean(one) for one in value]
    if isinstance(value, str) and re.fullmatch(r"-?\d+(\.\d+)?|-?Infinity|NaN", value):
        return float(value)
    return value


def header(values, child=None):
    data = [{"key": "frame_id", "value": [values["frame_id"]]}]
    if child:
        data.append({"key": "child_frame_id", "value": [child]})
    return {"stamp": time_of(values["stamp"]), "data": data}


def time_of(stamp):
    return {"sec": stamp["sec"], "nsec": stamp["nanosec"]}


def image(values, pixel_format):
    return {"header": header(values["header"]), "width": values["width"], "height": values["height"],
            "step": values["step"], "pixel_format_type": pixel_format,
            "data": base64.b64encode(values["data"]).decode()}


def labels(values, pixels):
    return {**image(values, "RGB_INT8"), "step": 3 * values["width"],
            "data": base64.b64encode(bytes(byte for pixel in pixels for byte in pixel)).decode()}


def numbers(data, size):
    return [int.from_bytes(data[i:i + size], "little") for i in range(0, len(data), size)]


def semantic(values, _):
    return labels(values, ((label,) * 3 for label in numbers(values["data"], 2)))


def panoptic(values, classes):
    return labels(values, ((i & 255, i >> 8, label) for i, label in
                           zip(numbers(values["data"], 4), numbers(classes["data"], 2))))


def scan(values, _):
    return {"header": header(values["header"]), "frame": values["header"]["frame_id"],
            "range_min": values["min_range"], "range_max": values["max_range"], "count": 1, "vertical_count": 1,
            "ranges": [values["range"]], "intensities": [0]}


def transforms(values, _):
    poses = [{"header": header(one["header"], one["child_frame_id"]), "name": one["child_frame_id"],
              "position": one["transform"]["translation"], "orientation": one["transform"]["rotation"]}
             for one in values["transforms"]]
    return {"header": {"stamp": time_of(values["transforms"][0]["header"]["stamp"])}, "pose": poses}


TYPES = ("INT8", "UINT8", "INT16", "UINT16", "INT32", "UINT32", "FLOAT32", "FLOAT64")  # from 1 on in PointField


def cloud(values, _):
    return {**values, "header": header(values["header"]), "data": base64.b64encode(values["data"]).decode(),
            "fields": [],
            "field": [{**field, "datatype": TYPES[field["datatype"] - 1]} for field in values["fields"]]}


MESSAGES = {
    "/camera/image_raw": lambda values, _: image(values, "RGB_INT8"),
    "/camera/depth": lambda values, _: image(values, "R_FLOAT32"),
    "/camera/class": semantic, "/camera/id": panoptic,
    "/camera/camera_info": lambda values, _: {
        "header": header(values["header"]), "width": values["width"], "height": values["height"],
        "distortion": {"k": values["d"]}, "intrinsics": {"k": values["k"]}, "projection": {"p": values["p"]},
        "rectification_matrix": values["r"]},
    "/imu/data": lambda values, _: {
        "header": header(values["header"]), "entity_name": "imu_link", "orientation": values["orientation"],
        "angular_velocity": values["angular_velocity"], "linear_acceleration": values["linear_acceleration"]},
    "/gnss/fix": lambda values, _: {
        "header": header(values["header"]), "latitude_deg": values["latitude"], "longitude_deg": values["longitude"],
        "altitude": values["altitude"], "frame_id": "gnss_link"},
    "/odom": lambda values, _: {
        "header": header(values["header"], values["child_frame_id"]), "pose": values["pose"]["pose"],
        "twist": values["twist"]["twist"]},
    "/echo_sounder": scan, "/gauge": scan,
    "/bow_wave": lambda values, _: {"header": header(values["header"]), **values["point"]},
    "/buoy_wave": lambda values, _: {"header": header(values["header"]), **values["point"]},
    "/lidar/points": cloud, "/tf": transforms, "/tf_static": transforms}


def infinite(value):
    """As JSON has them, which has no word for infinity."""
    return json.loads(json.dumps(value), parse_constant=lambda word: float(word.replace("Infinity", "inf")))


class Transport(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def peer(self, mode, *words, **options):
        return Process(self, BIN / "gazebo_peer", mode, *words, **options)

    def heard(self, seconds, *arguments, topics=TOPICS):
        """All that a listener hears of a run in lock-step, and the recording's messages."""
        path = self.folder / "run.mcap"
        run = sim(self, "--clock", "input", "--inputs", "-", "--record", path, "--duration", seconds, *arguments)
        listener = self.peer("listen", *(word for topic in topics.values() for word in topic))
        listener.expect(self, "ready")
        lines = []
        reader = threading.Thread(target=lambda: lines.extend(listener.stdout))
        reader.start()
        for step in range(round(100 * seconds) + 1):
            run.say(clock_line(step * 10**7))
        run.stdin.close()
        run.stdin = None
        self.assertEqual(run.wait(400), 0)
        time.sleep(3.0)  # until the listener has written all
        listener.stdin.close()
        listener.stdin = None
        reader.join()
        return [json.loads(line) for line in lines], mcap_reader.read(path).messages

    def test_a_listener_gets_what_a_recording_has(self):
        heard, recorded = self.heard(10)
        by_topic, expected = collections.defaultdict(list), collections.defaultdict(list)
        for one in heard:
            by_topic[one["topic"]].append(one["message"])
        for message in recorded:
            expected[message.topic].append(message.values)
        self.assertEqual(set(expected), set(TOPICS))
        expected["/tf_static"] *= 10  # again in each second
        self.assertEqual({topic: len(messages) for topic, messages in by_topic.items()},
                         {TOPICS[topic][0]: len(messages) for topic, messages in expected.items()})
        self.assertEqual(len(by_topic["/camera/image"]), 200)
        for topic, messages in expected.items():
            for n, values in enumerate(messages):
                classes = expected["/camera/class"][n] if topic == "/camera/id" else None
                wanted = clean(infinite(MESSAGES[topic](values, classes)))
                self.assertEqual(clean(by_topic[TOPICS[topic][0]][n]), wanted, (topic, n))

    def test_the_bytes_are_the_same_with_any_number_of_threads(self):
        one, two = ([(message["topic"], message["hash"]) for message in self.heard(0.5, "--threads", threads)[0]]
                    for threads in (1, 2))
        self.assertGreater(len(one), 200)
        self.assertEqual(one, two)

    def test_poses_and_the_clock_of_another_process_are_taken_as_those_of_a_file(self):
        rig = self.folder / "rig.toml"
        rig.write_text('[[body]]\nframe = "boat"\npose = "input"\n[[camera]]\nname = "camera"\nbody = "boat"\n'
                       f'width_px = {WIDTH}\nheight_px = {HEIGHT}\n[[odometry]]\nname = "odom"\nbody = "boat"\n')
        lines, texts = [], []
        for step in range(101):
            t_ns, x = step * 10**7, 0.05 * step
            half = 0.5 * math.radians(0.3 * step)
            position, turn = [x, 20.0 - x, 1.5], [0.0, 0.0, math.sin(half), math.cos(half)]
            lines += [json.dumps({"body": "boat", "stamp_ns": t_ns, "position": position, "orientation": turn}),
                      clock_line(t_ns)]
            stamp = f"sec: {t_ns // 10**9} nsec: {t_ns % 10**9}"
            point, quaternion = (" ".join(f"{axis}: {value!r}" for axis, value in zip("xyzw", values))
                                 for values in (position, turn))
            texts += [f"/model/boat/pose header {{ stamp {{ {stamp} }} }} name: \"boat\" position {{ {point} }} "
                      f"orientation {{ {quaternion} }}", f"/clock sim {{ {stamp} }}"]
        (self.folder / "inputs.jsonl").write_text("\n".join(lines) + "\n")
        common = ("--scene", SCENE, "--rig", rig, "--clock", "input", "--duration", "1", "--record")
        subprocess.run([BIN / "swell-sim", *common, self.folder / "file.mcap", "--inputs",
                        self.folder / "inputs.jsonl"], check=True, capture_output=True)
        run = Process(self, BIN / "swell-sim", *common, self.folder / "transport.mcap", "--gazebo", "on",
                      stderr=subprocess.DEVNULL)
        speaker = self.peer("say", "/model/boat/pose", "Pose", "/clock", "Clock")
        speaker.expect(self, "ready")
        speaker.communicate("\n".join(texts) + "\n", timeout=60)
        self.assertEqual(run.wait(60), 0)
        self.assertTrue((self.folder / "file.mcap").read_bytes() == (self.folder / "transport.mcap").read_bytes())
        self.assertEqual(len([m for m in mcap_reader.read(self.folder / "transport.mcap").messages
                              if m.topic == "/camera/image_raw"]), 20)

    def test_damaged_messages_are_told_of_in_a_line(self):
        rig = self.folder / "rig.toml"
        rig.write_text('[[body]]\nframe = "boat"\npose = "input"\n[[pose]]\nname = "tip"\nbody = "boat"\n')
        run = Process(self, BIN / "swell-sim", "--scene", SCENE, "--rig", rig, "--gazebo", "on", "--clock", "input",
                      stderr=subprocess.PIPE)
        self.assertIn("gazebo: partition", run.stderr.readline())
        stamp = "header { stamp { sec: 3 nsec: 250000000 } }"
        for words in (("/model/boat/pose", "Pose", f'{stamp} name: "boat" position {{ x: 3 }} orientation {{ w: 1 }}'),
                      ("/clock", "Clock", "sim { sec: 3 nsec: 250000000 }")):
            self.assertEqual(self.peer("damage", 2000, *words).wait(60), 0)
        run.terminate()
        _, said = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0, said)
        lines = said.splitlines()
        self.assertTrue(all(line.startswith(("warning: ", "note: ")) for line in lines), said)
        for topic in ("/model/boat/pose", "/clock"):
            self.assertEqual(sum(line.startswith(f"warning: {topic}: ") for line in lines), 1, said)

    def test_the_water_service_answers_as_the_python_package(self):
        try:
            import numpy
            import swell
        except ImportError:
            self.skipTest("no Python package")
        run = sim(self, "--clock", "input", "--inputs", "-", "--measure")
        asker = self.peer("heights")
        run.say(clock_line(1_230_000_000))
        points = numpy.array([[4.0, 20.0], [22.0, -25.0], [-31.5, 7.25], [100.0, 80.0]])
        text = " ".join(f"pose {{ position {{ x: {x} y: {y} }} }}" for x, y in points)
        time.sleep(2.0)
        world = swell.World(SCENE)
        for stamp, request in ((None, text), (7.5, f"header {{ stamp {{ sec: 7 nsec: 500000000 }} }} {text}")):
            asker.say(request)
            reply = json.loads(asker.stdout.readline())
            at = reply["header"]["stamp"]
            t = int(at.get("sec", 0)) + at.get("nsec", 0) / 1e9
            self.assertEqual(t, stamp or 1.23)
            heights = [pose["position"].get("z", 0.0) for pose in reply["pose"]]
            self.assertEqual(heights, [float(z) for z in world.height(points, t)])
        for wrong in ("pose { position { x: nan } }", "header { stamp { sec: -5 } }",
                      "pose { position { x: 1 } } " * 100_001):
            asker.say(wrong)
            self.assertEqual(asker.stdout.readline(), "refused\n")
        asker.say(text)
        self.assertIn("pose", asker.stdout.readline())

    @unittest.skipUnless((COMMANDS / "ign-transport-topic").exists(), "no ignition-transport-cli")
    def test_commands_for_shells_hear_and_ask(self):
        path = self.folder / "run.mcap"
        run = sim(self, "--realtime", "--duration", "1000", "--rig-set", "clock_hz=20", "--rig-set",
                  "camera[0].compressed=png", "--record", path)  # of which Gazebo has no message

        def command(name, *arguments):
            return subprocess.run([COMMANDS / f"ign-transport-{name}", *arguments], env=environment(), text=True,
                                  capture_output=True, timeout=60, check=True).stdout
        listed = set(command("topic", "-l").split())
        self.assertEqual(listed, {topic for topic, _ in TOPICS.values()} | {"/clock"})
        self.assertRegex(command("topic", "-e", "-n", "1", "-t", "/clock"),
                         r"^sim \{\s+(sec: \d+\s+)?(nsec: \d*[05]0000000\s+)?\}")
        info = command("topic", "-e", "-n", "1", "-t", "/camera/camera_info")
        self.assertIn(f"width: {WIDTH}\nheight: {HEIGHT}\n", info)
        self.assertIn('value: "camera_optical_frame"', info)
        self.assertIn('name: "base_link"', command("topic", "-e", "-n", "1", "-t", "/tf"))
        state = command("service", "-s", "/water/sea_state", "--reqtype", "ignition.msgs.Empty", "--reptype",
                        "ignition.msgs.Param", "--timeout", "10000", "--req", "")
        self.assertRegex(state, r'key: "wind_speed_mps"\s+value \{\s+type: DOUBLE\s+double_value: 3\b')
        shown = {topic: command("topic", "-e", "-n", "1", "-t", TOPICS[topic][0])
                 for topic in ("/camera/image_raw", "/camera/depth")}
        self.assertIsNone(run.poll())
        run.terminate()
        self.assertEqual(run.wait(60), 0)
        recorded = {(message.topic, message.t_ns): message.values for message in mcap_reader.read(path).messages}
        for topic, text in shown.items():
            sec, nsec = (re.search(rf"\b{unit}: (\d+)", text) for unit in ("sec", "nsec"))
            t_ns = 10**9 * int(sec[1] if sec else 0) + int(nsec[1] if nsec else 0)
            data = codecs.escape_decode(re.search('^data: "(.*)"$', text, re.MULTILINE)[1].encode())[0]
            self.assertTrue(data == recorded[topic, t_ns]["data"], topic)

    def test_many_listeners_that_come_and_go_change_nothing(self):
        common = ("--duration", "8", "--realtime", "--record")
        run = sim(self, *common, self.folder / "visited.mcap")
        visitors = [self.peer("visit", 100, "/camera/image", "Image") for _ in range(10)]
        for visitor in visitors[5:]:
            time.sleep(0.2)
            visitor.kill()  # without a word
        self.assertEqual(run.wait(120), 0)
        for visitor in visitors[:5]:
            visitor.wait(60)  # however: Fortress's library may end it by a signal
        subprocess.run([BIN / "swell-sim", "--scene", SCENE, "--rig", RIG, *SMALL, "--duration", "8", "--record",
                        self.folder / "alone.mcap"], check=True, capture_output=True)
        self.assertTrue((self.folder / "alone.mcap").read_bytes() == (self.folder / "visited.mcap").read_bytes())

    def test_what_is_not_right_is_one_line(self):
        ok = ("--scene", SCENE, "--rig", RIG)
        for arguments, words in (((*ok, "--gazebo", "yes"), "--gazebo: got 'yes', allowed off or on"),
                                 ((*ok, "--gazebo", "off"), "got nothing to do"),
                                 ((*ok, "--gazebo", "on", "--clock", "input", "--gazebo-poses", "a b", "--rig-set",
                                   "body[0].mount=", "--rig-set", "body[0].pose=input"),
                                  "--gazebo-poses: got 'a b'")):
            done = subprocess.run([BIN / "swell-sim", *arguments], capture_output=True, text=True, env=environment(),
                                  check=False)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr.splitlines()[-1])


class Loopback(unittest.TestCase):
    def test_no_packet_leaves_it(self):
        if os.environ.get("SWELL_OWN_NETWORK") != "1":
            own = ["unshare", "--user", "--map-root-user", "--net"]
            link = ["ip", "link", "add", "v0", "type", "veth", "peer", "name", "v1"]
            if subprocess.run([*own, *link], capture_output=True, check=False).returncode != 0:
                self.skipTest("no network of its own")
            done = subprocess.run([*own, sys.executable, "-B", __file__, *sys.argv[1:4], "Loopback"],
                                  env={**os.environ, "SWELL_OWN_NETWORK": "1"}, capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return
        for command in ("link set lo up", "link add v0 type veth peer name v1", "addr add 10.9.8.1/24 dev v0"):
            subprocess.run(["ip", *command.split()], check=True)
        pathlib.Path("/proc/sys/net/ipv6/conf/v0/disable_ipv6").write_text("1")  # which sends by itself
        for command in ("link set v0 up", "link set v1 up", "route add default via 10.9.8.2"):
            subprocess.run(["ip", *command.split()], check=True)
        self.assertEqual(self.packets("127.0.0.1"), 0)
        self.assertGreater(self.packets("10.9.8.1"), 0)

    def packets(self, ip):
        """How many left by the other interface during a run that somebody listens to."""
        def sent():
            lines = pathlib.Path("/proc/net/dev").read_text().splitlines()
            return next(int(line.split()[10]) for line in lines if line.strip().startswith("v0:"))
        before = sent()
        run = sim(self, ip=ip)
        listener = Process(self, BIN / "gazebo_peer", "listen", "/imu", "IMU", ip=ip)
        self.assertTrue(any('{"topic": "/imu"' in line for line in listener.stdout))
        listener.close()
        run.close()
        return sent() - before


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
