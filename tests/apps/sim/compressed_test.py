"""Compressed pictures of swell-sim's recordings, as the Python Imaging Library decodes them: compressed_test.py BIN
SOURCE [CASE ...]."""
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

import mcap_reader
import numpy as np

try:
    from PIL import Image
except ImportError:
    Image = None

BIN, SOURCE = (pathlib.Path(path) for path in sys.argv[1:3])
SCENE, RIG = SOURCE / "scenes/harbour.toml", SOURCE / "scenes/rigs/harbour_boat.toml"
WIDTH, HEIGHT = 160, 90
RAW, COMPRESSED = "/camera/image_raw", "/camera/image_raw/compressed"


def run(path, *settings, threads=2):
    more = [f"camera[0].width_px={WIDTH}", f"camera[0].height_px={HEIGHT}", "lidar[0].columns=16", *settings]
    return subprocess.run([BIN / "swell-sim", "--scene", SCENE, "--rig", RIG, "--record", path, "--duration", "0.2",
                           "--threads", str(threads), *(word for setting in more for word in ("--rig-set", setting))],
                          capture_output=True, text=True, check=False)


@unittest.skipUnless(Image, "no PIL")
class Compressed(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.path = pathlib.Path(scratch.name) / "run.mcap"

    def recorded(self, *settings, threads=2):
        """{topic: [(type, values)]}"""
        done = run(self.path, *settings, threads=threads)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        topics = {}
        for message in mcap_reader.read(self.path).messages:
            topics.setdefault(message.topic, []).append((message.type, message.values))
        return topics

    def pictures(self, coding, *settings):
        """(picture as it is, as it is decoded, its bytes) of each frame."""
        topics = self.recorded(f"camera[0].compressed={coding}", *settings)
        self.assertEqual((len(topics[RAW]), len(topics[COMPRESSED])), (4, 4))
        for (_, raw), (kind, values) in zip(topics[RAW], topics[COMPRESSED]):
            self.assertEqual(kind, "sensor_msgs/msg/CompressedImage")
            self.assertEqual(values["header"], raw["header"])
            self.assertEqual(values["format"], f"rgb8; {coding} compressed bgr8")
            picture = Image.open(io.BytesIO(values["data"]))
            self.assertEqual((picture.format, picture.mode, picture.size), (coding.upper(), "RGB", (WIDTH, HEIGHT)))
            yield (np.frombuffer(raw["data"], np.uint8).reshape(HEIGHT, WIDTH, 3), np.asarray(picture),
                   values["data"])

    def test_png_is_the_picture(self):
        for picture, decoded, _ in self.pictures("png"):
            self.assertTrue((picture == decoded).all())

    def test_jpeg_is_the_picture_as_far_as_its_quality_says(self):
        error, size = {}, {}
        for quality in (50, 95):
            shown = list(self.pictures("jpeg", f"camera[0].jpeg_quality={quality}"))
            for picture, decoded, data in shown:
                # No other libjpeg encodes what it decodes to any nearer at the quality.
                other = io.BytesIO()
                Image.fromarray(picture).save(other, "JPEG", quality=quality, subsampling="4:2:0")
                theirs = np.asarray(Image.open(other)).astype(float)
                ours, known = decoded.astype(float) - picture, theirs - picture
                self.assertLess(np.sqrt((ours**2).mean()), 1.02 * np.sqrt((known**2).mean()) + 0.02)
                self.assertLess(abs(len(data) - len(other.getvalue())), 0.05 * len(data) + 700)
            error[quality] = np.mean([np.abs(d.astype(float) - p).mean() for p, d, _ in shown])
            size[quality] = sum(len(data) for *_, data in shown)
        self.assertLess(error[95], 0.7 * error[50])
        self.assertLess(size[50], 0.6 * size[95])

    def test_a_lens_bends_both_pictures(self):
        for picture, decoded, _ in self.pictures("png", "camera[0].distortion=[-0.25, 0.05, 0, 0, 0]"):
            self.assertTrue((picture == decoded).all())

    def test_runs_on_any_number_of_threads_have_the_same_bytes(self):
        recordings = []
        for threads in (1, 2):
            self.recorded("camera[0].compressed=jpeg", threads=threads)
            recordings.append(self.path.read_bytes())
        self.assertTrue(recordings[0] == recordings[1])

    def test_the_picture_as_it_is_can_be_left_out(self):
        topics = self.recorded("camera[0].raw=false", "camera[0].compressed=png")
        self.assertNotIn(RAW, topics)
        self.assertEqual(len(topics[COMPRESSED]), 4)
        topics = self.recorded("camera[0].raw=false")
        self.assertEqual({topic for topic in topics if topic.startswith("/camera")},
                         {"/camera/camera_info", "/camera/depth", "/camera/class", "/camera/id"})

    def test_what_is_not_right_is_one_line(self):
        for setting, words in (("compressed=webp", 'camera[0].compressed, got "webp", allowed'),
                               ("jpeg_quality=0", "camera[0].jpeg_quality, got 0, allowed an integer, 1 to 100")):
            done = run(self.path, "camera[0]." + setting)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
