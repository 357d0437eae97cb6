"""Holds `macula compare` to the authors' own FLIP (flip-evaluator from PyPI) on rendered frames.

Usage: flip.py MACULA SCRATCH, in an environment with flip-evaluator and numpy; see flip.sh.
"""

import json
import os
import struct
import subprocess
import sys
import zlib

import flip_evaluator
import numpy

MEAN_TOLERANCE = 1e-4
PIXEL_TOLERANCE = 1e-3


def read_map(path):
    """The one channel of floats of a ZIP-compressed EXR file, as `--heatmap FILE.exr` writes it."""
    data = open(path, "rb").read()
    at, header = 8, {}
    while data[at]:
        name, kind = (s.decode() for s in data[at:].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    assert header["compression"] == b"\3", "ZIP compression was expected"
    blocks = (height + 15) // 16
    image = numpy.empty((height, width), numpy.float32)
    for offset in struct.unpack_from(f"<{blocks}Q", data, at + 1):
        row, size = struct.unpack_from("<ii", data, offset)
        rows = min(16, top + height - row)
        packed = data[offset + 8 : offset + 8 + size]
        raw = packed
        if size < rows * width * 4:
            steps = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).astype(numpy.int64)
            steps[1:] -= 128
            split = (numpy.cumsum(steps) & 255).astype(numpy.uint8)
            joined = numpy.empty_like(split)
            half = (len(split) + 1) // 2
            joined[0::2], joined[1::2] = split[:half], split[half:]
            raw = joined.tobytes()
        image[row - top : row - top + rows] = numpy.frombuffer(raw, "<f4").reshape(rows, width)
    return image


def write_exr(path, pixels):
    """Channels B, G, R of floats, without compression."""
    height, width, _ = pixels.shape
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R"))
    header = b"".join(
        name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
        for name, kind, value in (
            (b"channels", b"chlist", channels + b"\0"), (b"compression", b"compression", b"\0"),
            (b"dataWindow", b"box2i", window), (b"displayWindow", b"box2i", window),
            (b"lineOrder", b"lineOrder", b"\0"),
            (b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
            (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0.0, 0.0)),
            (b"screenWindowWidth", b"float", struct.pack("<f", 1.0))))
    start = 8 + len(header) + 1 + 8 * height
    row_size = 8 + 12 * width
    with open(path, "wb") as file:
        file.write(struct.pack("<ii", 20000630, 2) + header + b"\0")
        file.write(struct.pack(f"<{height}Q", *(start + y * row_size for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, 12 * width))
            file.write(pixels[y, :, ::-1].T.astype("<f4").tobytes())


class Comparison:
    def __init__(self, macula, scratch):
        self.macula, self.scratch, self.failures, self.count = macula, scratch, 0, 0

    def render(self, name, *arguments):
        folder = os.path.join(self.scratch, name)
        command = [self.macula, "render", *arguments, "--out", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return os.path.join(folder, "frame_0000")

    def compare(self, what, reference, test, ppd, hdr=False, tone_mapper="aces"):
        """One pair of files, ours against theirs."""
        ours_file = os.path.join(self.scratch, "map.exr")
        options = ["--json", "--ppd", str(ppd), "--heatmap", ours_file]
        options += ["--hdr", "--tone-mapper", tone_mapper] if hdr else []
        command = [self.macula, "compare", reference, test, *options]
        printed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        ours = read_map(ours_file)
        parameters = {"ppd": ppd, **({"tonemapper": tone_mapper} if hdr else {})}
        theirs, mean, used = flip_evaluator.evaluate(
            reference, test, "HDR" if hdr else "LDR", applyMagma=False, parameters=parameters
        )
        mean_off = abs(printed["flip_mean"] - mean)
        pixel_off = float(numpy.abs(theirs[..., 0] - ours).max())
        bad = mean_off > MEAN_TOLERANCE or pixel_off > PIXEL_TOLERANCE
        if hdr:
            found = printed["exposures"]
            bad |= abs(found["start"] - used["startExposure"]) > 1e-4
            bad |= abs(found["stop"] - used["stopExposure"]) > 1e-4
            bad |= found["count"] != used["numExposures"]
        verdict = "DIFFERS" if bad else "agrees"
        print(f"flip: {what}: mean {mean:.6f}, off by {mean_off:.1e}, pixels by {pixel_off:.1e}: "
              f"{verdict}")
        self.failures += bad
        self.count += 1


def check_exposures(run):
    """Automatic exposures where the median is one of two, or black."""
    random = numpy.random.default_rng(1)
    spot = numpy.zeros((5, 5, 3))
    spot[0, 0], spot[0, 1] = 4.0, 0.5
    for what, pixels in (("odd", random.random((5, 5, 3)) * 9.0),
                         ("even", random.random((4, 5, 3)) * 9.0),
                         ("mostly black", spot), ("mostly dim", spot + 2e-7)):
        reference = os.path.join(run.scratch, "reference.exr")
        test = os.path.join(run.scratch, "test.exr")
        write_exr(reference, pixels)
        write_exr(test, pixels * 0.5 + 0.01)
        run.compare(f"exposures, {what}", reference, test, 67.02, True)


def main(macula, scratch):
    run = Comparison(macula, scratch)
    view = ("--size", "320x240", "--lights", "area")
    atrium = run.render("atrium", "atrium", *view)
    coarse = run.render("coarse", "atrium", "--method", "lowres", *view)
    box = run.render("box", "cornell", "--size", "131x97", "--lights", "area", "--spp", "4")
    noisy = run.render("noisy", "cornell", "--size", "131x97", "--lights", "area",
                       "--light-samples", "1", "--seed", "3")
    for ppd in (67.02, 20.0):
        run.compare(f"atrium, full and lowres, {ppd} ppd", atrium + ".png", coarse + ".png", ppd)
        run.compare(f"cornell with noise, {ppd} ppd", box + ".png", noisy + ".png", ppd)
    for tone_mapper in ("aces", "hable", "reinhard"):
        run.compare(f"atrium, HDR, {tone_mapper}", atrium + ".exr", coarse + ".exr", 67.02, True,
                    tone_mapper)
    run.compare("cornell with noise, HDR", box + ".exr", noisy + ".exr", 67.02, True)
    run.compare("cornell the other way, HDR", noisy + ".exr", box + ".exr", 30.0, True)
    check_exposures(run)
    print(f"flip: {run.count} comparisons, {run.failures} differ")
    return run.failures != 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
