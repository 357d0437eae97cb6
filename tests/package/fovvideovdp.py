"""What bench/fovvideovdp.sh hands to FovVideoVDP, and that it says why where it cannot.

Usage: fovvideovdp.py BUILD-DIRECTORY. The metric itself is run only where it is installed there.
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPT = os.path.join(SOURCE, "bench", "fovvideovdp.sh")
BUILD = os.path.abspath(sys.argv.pop(1))


def write_png(path, width, height, shade):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    rows = b"".join(
        b"\0" + bytes((x * 7 + y * 5 + shade) % 256 for x in range(width) for _ in "RGB")
        for y in range(height))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class FovVideoVdp(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        for folder, shade in (("reference", 0), ("test", 40)):
            os.mkdir(self.path(folder))
            for frame in range(2, 6):
                write_png(self.path(f"{folder}/frame_{frame:04}.png"), 64, 80, shade)
        # A build directory without the metric.
        os.mkdir(self.path("build"))
        os.symlink(os.path.join(BUILD, "macula"), self.path("build/macula"))

    def tearDown(self):
        self.scratch.cleanup()

    def path(self, name):
        return os.path.join(self.scratch.name, name)

    def prepare(self, *arguments):
        command = [sys.executable, SCRIPT[:-3] + ".py", "prepare", os.path.join(BUILD, "macula"),
                   *arguments]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.scratch.name)

    def clip(self, *arguments):
        result = self.prepare(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_writes_frames_fixations_and_display(self):
        clip = self.clip("reference", "test", "--gaze", "10,-5", "--eye", "left")
        self.assertEqual([os.path.basename(f) for f in clip["test_frames"]],
                         [f"frame_{n:04}.png" for n in range(2, 6)])
        self.assertTrue(all(os.path.isfile(f) for f in clip["reference_frames"]))
        self.assertEqual((clip["width"], clip["height"], clip["fps"]), (64, 80, 75.0))
        self.assertEqual(clip["display"]["tangents"],
                         {"left": 1.0586, "right": 1.0924, "up": 1.3299, "down": 1.3299})
        self.assertEqual(len(clip["fixations"]), 4)
        # As `macula displays` projects the same gaze, there from the corner of the pixel.
        displays = [os.path.join(BUILD, "macula"), "displays", "dk2", "--json", "--gaze", "10,-5"]
        shown = subprocess.run(displays, capture_output=True, text=True, check=True).stdout
        left = next(e for e in json.loads(shown)["displays"][0]["eyes"] if e["eye"] == "left")
        x, y = left["gaze_pixel"]
        expected = (x / 1182 * 64 - 0.5, y / 1464 * 80 - 0.5)
        for point in clip["fixations"]:
            self.assertAlmostEqual(point[0], expected[0], places=4)
            self.assertAlmostEqual(point[1], expected[1], places=4)

    def test_fixations_follow_a_moving_gaze_from_the_first_frame_on(self):
        moving = self.clip("reference", "test", "--gaze", "target:seed=3", "--fps", "10")
        os.remove(self.path("reference/frame_0002.png"))
        os.remove(self.path("test/frame_0002.png"))
        later = self.clip("reference", "test", "--gaze", "target:seed=3", "--fps", "10")
        self.assertNotEqual(moving["fixations"][0], moving["fixations"][1])
        self.assertEqual(moving["fixations"][1:], later["fixations"])

    def test_names_what_is_missing(self):
        def refusal(*arguments):
            result = self.prepare(*arguments)
            self.assertEqual(result.returncode, 1, result.stdout)
            return result.stderr

        self.assertIn("'none': there is no such folder", refusal("none", "test"))
        self.assertIn("there is no display", refusal("reference", "test", "--display", "dk9"))
        self.assertIn("canted", refusal("reference", "test", "--display", "pimax_8k_large", "--eye",
                                        "left"))
        os.remove(self.path("test/frame_0005.png"))
        self.assertIn("only one has frame 5", refusal("reference", "test"))
        os.remove(self.path("test/frame_0003.png"))
        self.assertIn("'test': frame 3 is missing", refusal("reference", "test"))
        write_png(self.path("reference/frame_0003.png"), 60, 80, 0)
        self.assertIn("frame_0003.png': 64 x 80 pixels", refusal("reference", "reference"))

    def run_script(self, build, *arguments):
        environment = {k: v for k, v in os.environ.items() if k != "MACULA_PYPI"}
        return subprocess.run([SCRIPT, build, *arguments], capture_output=True, text=True,
                              env=environment, cwd=self.scratch.name)

    def test_skips_with_a_reason_where_the_metric_is_not_installed(self):
        result = self.run_script(self.path("build"), "reference", "test")
        self.assertEqual(result.returncode, 77, result.stderr)
        self.assertRegex(result.stdout, r"^fovvideovdp: skipped \(pyfvvdp is not installed; .*\)$")
        self.assertFalse(os.path.exists(self.path("build/fovvideovdp")), "nothing was installed")

    def test_judges_where_the_metric_is_installed(self):
        result = self.run_script(BUILD, "reference", "reference", "test")
        if result.returncode == 77:
            self.skipTest(result.stdout.strip())
        self.assertEqual(result.returncode, 0, result.stderr)
        same, other = (json.loads(line) for line in result.stdout.splitlines())
        self.assertEqual(same["jod"], 10.0)
        self.assertEqual(same["frames"], 4)
        self.assertLess(other["jod"], 9.9)


if __name__ == "__main__":
    unittest.main()
