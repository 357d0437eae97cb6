"""Sequences of frames before FovVideoVDP (Mantiuk et al. 2021), an outside judge of foveated video.

  fovvideovdp.py prepare MACULA REFERENCE TEST... [options]   one JSON line for each clip
  fovvideovdp.py judge                                        clips on standard input, JOD out

`prepare` needs nothing but Python and `macula`: it writes down the frames, the fixation point of
every frame and the display. `judge` needs pyfvvdp, whose licence forbids shipping it: see
fovvideovdp.sh, which installs it into an environment of its own and joins both.
"""

import argparse
import csv
import io
import json
import math
import os
import re
import subprocess
import sys


class Refusal(Exception):
    """Bad input; its text names what and where."""


def frames_of(folder):
    """{number: path} of the PNG files of a folder, without gaps."""
    if not os.path.isdir(folder):
        raise Refusal(f"'{folder}': there is no such folder")
    frames = {}
    for name in os.listdir(folder):
        match = re.fullmatch(r".*?(\d+)\.png", name)
        if match and not name.startswith("."):
            frames[int(match[1])] = os.path.abspath(os.path.join(folder, name))
    if not frames:
        raise Refusal(f"'{folder}': it holds no numbered PNG files")
    for number in range(min(frames), max(frames) + 1):
        if number not in frames:
            raise Refusal(f"'{folder}': frame {number} is missing")
    return frames


def png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    if len(head) < 24 or head[:8] != b"\x89PNG\r\n\x1a\n":
        raise Refusal(f"'{path}': not a PNG file")
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


def run(command):
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        raise Refusal(result.stderr.strip() or f"{command[0]} ended with {result.returncode}")
    return result.stdout


def find_eye(macula, display, eye):
    described = json.loads(run([macula, "displays", display, "--json"]))["displays"][0]
    found = next(e for e in described["eyes"] if e["eye"] == eye)
    if max(abs(angle) for angle in found["axis_degrees"]) > 1e-6:
        raise Refusal(f"display \"{display}\": its {eye} eye is canted; FovVideoVDP's is not")
    return found["tangents"], described["refresh_hz"]


def fixations(macula, options, tangents, fps, size, first, count):
    """Pixels (x, y) from the upper left corner's pixel, one for each frame."""
    command = [macula, "gaze", "sample", options.gaze, "--display", options.display,
               "--rate", repr(fps), "--seconds", repr((first + count + 1) / fps)]
    if options.tracker:
        command += ["--tracker", options.tracker]
    rows = list(csv.DictReader(io.StringIO(run(command))))[first : first + count]
    if len(rows) != count:
        raise Refusal(f"--gaze \"{options.gaze}\": {len(rows)} samples for {count} frames")
    points = []
    for row in rows:
        azimuth = math.radians(float(row["right_degrees"]))
        elevation = math.radians(float(row["up_degrees"]))
        # On the plane at distance 1 before the eye, x to the right and y up.
        x = math.tan(azimuth)
        y = math.tan(elevation) / math.cos(azimuth)
        points.append([
            (x + tangents["left"]) / (tangents["left"] + tangents["right"]) * size[0] - 0.5,
            (tangents["up"] - y) / (tangents["up"] + tangents["down"]) * size[1] - 0.5])
    return points


def prepare(options):
    reference = frames_of(options.reference)
    numbers = sorted(reference)
    size = png_size(reference[numbers[0]])
    tangents, refresh = find_eye(options.macula, options.display, options.eye)
    fps = options.fps or refresh
    points = fixations(options.macula, options, tangents, fps, size, numbers[0], len(numbers))
    for folder in options.tests:
        test = frames_of(folder)
        if sorted(test) != numbers:
            odd = min(set(test) ^ set(numbers))
            raise Refusal(f"'{folder}' and '{options.reference}': only one has frame {odd}")
        for path in [*test.values(), *reference.values()]:
            if png_size(path) != size:
                raise Refusal(f"'{path}': {size[0]} x {size[1]} pixels were expected")
        print(json.dumps({
            "reference": options.reference, "test": folder,
            "reference_frames": [reference[n] for n in numbers],
            "test_frames": [test[n] for n in numbers],
            "width": size[0], "height": size[1], "fps": fps, "fixations": points,
            "display": {"name": options.display, "eye": options.eye, "tangents": tangents,
                        "luminance": options.luminance, "contrast": options.contrast}}))


def judge():
    import imageio.v2 as imageio
    import numpy
    import pyfvvdp
    import torch
    from pyfvvdp.video_source import fvvdp_video_source_dm

    class Eye(pyfvvdp.fvvdp_display_geometry):
        """A plane before the eye that need not lie in the middle."""

        def __init__(self, clip):
            self.tangents = clip["display"]["tangents"]
            width = self.tangents["left"] + self.tangents["right"]
            super().__init__((clip["width"], clip["height"]),
                             fov_horizontal=2 * math.degrees(math.atan(width / 2)))

        def pix2view_direction(self, resolution_pix, x_pix, y_pix):
            t = self.tangents
            x = x_pix / resolution_pix[0] * (t["left"] + t["right"]) - t["left"]
            y = t["up"] - y_pix / resolution_pix[1] * (t["up"] + t["down"])
            return torch.stack((torch.rad2deg(torch.atan(x)), torch.rad2deg(torch.atan(y))), dim=0)

    class Frames(fvvdp_video_source_dm):
        """Reads one frame at a time."""

        def __init__(self, clip, photometry):
            super().__init__(display_photometry=photometry)
            self.clip = clip

        def get_video_size(self):
            return self.clip["height"], self.clip["width"], len(self.clip["test_frames"])

        def get_frames_per_second(self):
            return self.clip["fps"]

        def get_test_frame(self, frame, device=torch.device("cpu")):
            return self.luminance(self.clip["test_frames"][frame], device)

        def get_reference_frame(self, frame, device=torch.device("cpu")):
            return self.luminance(self.clip["reference_frames"][frame], device)

        def luminance(self, path, device):
            pixels = numpy.asarray(imageio.imread(path))[..., :3].astype(numpy.float32) / 255.0
            light = self.dm_photometry.forward(torch.tensor(pixels, device=device))
            weights = torch.as_tensor(self.color_to_luminance, device=device).flatten()[:3]
            return (light * weights).sum(dim=-1)[None, None, None]

    for line in sys.stdin:
        clip = json.loads(line)
        photometry = pyfvvdp.fvvdp_display_photo_eotf(
            clip["display"]["luminance"], contrast=clip["display"]["contrast"], EOTF="sRGB",
            E_ambient=0)
        metric = pyfvvdp.fvvdp(display_photometry=photometry, display_geometry=Eye(clip),
                               foveated=True, quiet=True)
        with torch.no_grad():
            jod, _ = metric.predict_video_source(
                Frames(clip, photometry), fixation_point=numpy.array(clip["fixations"]))
        print(json.dumps({"reference": clip["reference"], "test": clip["test"],
                          "frames": len(clip["test_frames"]), "fps": clip["fps"],
                          "display": clip["display"]["name"], "jod": float(jod),
                          "metric": metric.get_info_string()}), flush=True)


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    modes = parser.add_subparsers(dest="mode", required=True)
    clips = modes.add_parser("prepare")
    clips.add_argument("macula", help="the program")
    clips.add_argument("reference", help="folder of PNG frames")
    clips.add_argument("tests", nargs="+", help="folders of PNG frames")
    clips.add_argument("--display", default="dk2")
    clips.add_argument("--eye", default="mono", choices=["mono", "left", "right"])
    clips.add_argument("--gaze", default="0,0", help="as --gaze of render")
    clips.add_argument("--tracker", default="", help="as --tracker of render")
    clips.add_argument("--fps", type=float, help="default: the display's refresh rate")
    clips.add_argument("--luminance", type=float, default=100.0, help="of white, cd/m^2")
    clips.add_argument("--contrast", type=float, default=1000.0, help="white to black")
    modes.add_parser("judge")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    try:
        if options.mode == "prepare":
            prepare(options)
        else:
            judge()
    except Refusal as refusal:
        print(f"fovvideovdp: {refusal}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
