"""Reads a dump of known values with OpenImageIO and exrheader, neither of which shares code with ours.

Usage: check_exr.py TEST_PROGRAM   (exit code 77: a reader is not installed)
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import OpenImageIO as oiio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (on Debian: apt-get install python3-openimageio python3-numpy)")
    sys.exit(77)

FACE_PX = 4
# GL's cube map faces, from the table in its specification: right (s), row direction (t), forward.
GL_FACES = [
    ((0, 0, -1), (0, -1, 0), (1, 0, 0)),
    ((0, 0, 1), (0, -1, 0), (-1, 0, 0)),
    ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((1, 0, 0), (0, -1, 0), (0, 0, 1)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, -1)),
]


def direction(face, column, row):
    """Through the centre of a texel, ((i + 1/2) / n), axial length 1."""
    right, rows, forward = (np.array(v, dtype=float) for v in face)
    u, v = ((2 * i + 1) / FACE_PX - 1 for i in (column, row))
    return forward + u * right + v * rows


def require(fine, what):
    if not fine:
        sys.exit(f"check_exr: {what}")


def check_pixels(file):
    spec = file.spec()
    require((spec.width, spec.height) == (FACE_PX, 6 * FACE_PX), "the size")
    require(spec.channelnames == ("Z", "distance", "id"), "the channels")
    depth, distance = np.moveaxis(file.read_image(0, 2, "float"), 2, 0)
    ids = file.read_image(2, 3, "uint").reshape(spec.height, spec.width)
    bases = [
        tuple(tuple(map(int, axis.split())) for axis in re.match(r"..: right (.*), down (.*), forward (.*)", text).groups())
        for text in spec.getattribute("zskelFaceBases").split("; ")
    ]
    seen = set()
    for y in range(spec.height):
        for x in range(spec.width):
            here = direction(bases[y // FACE_PX], x, y % FACE_PX)
            miss = ids[y, x] == 0xFFFFFFFF
            texel = 7 if miss else int(ids[y, x]) - 4_000_000_000
            seen.add(texel)
            face, row, column = texel // FACE_PX**2, texel // FACE_PX % FACE_PX, texel % FACE_PX
            require(np.array_equal(here, direction(GL_FACES[face], column, row)), f"texel {texel} is misplaced")
            expected = np.float32("inf") if miss else np.float32(1) + np.float32(texel) / np.float32(3)
            require(distance[y, x] == expected, f"the distance of texel {texel}")
            axial = np.float32(float(expected) / np.sqrt(here @ here))
            require(depth[y, x] == axial or abs(depth[y, x] / axial - 1) < 1e-6, f"Z of texel {texel}")
    require(seen == set(range(96)), "every texel once")


def check_attributes(spec):
    expected = {
        "zskelEyeModel": (0.1, 1 / 3, -1e-17),
        "zskelEyeWorld": (0.5, 0.25, -0.125),
        "zskelStep": 42,
        "zskelForce": (1 / 7, 2 / 7, -3 / 7),
        "zskelMeanInverseDistance": 1 / 9,
        "zskelHitFraction": 1 / 11,
        "zskelCenter": (1.0, 2.0, 3.0),
        "zskelScale": 0.1,
        "zskelModelFromWorld": (10.0, 0, 0, 0, 0, 10.0, 0, 0, 0, 0, 10.0, 0, 1.0, 2.0, 3.0, 1.0),
        "zskelModel": "known.obj",
        "zskelBackend": "test",
        "zskelVersion": "9.9.9",
    }
    for name, value in expected.items():
        found = spec.getattribute(name)
        require(found == value, f"{name} reads {found!r}, not {value!r}")
    require(np.float32(spec.getattribute("zskelNearPlane")) == np.float32(1e-6), "the near plane")


def check_header(path):
    if shutil.which("exrheader") is None:
        print("skipped: exrheader is not installed (on Debian: apt-get install openexr)")
        sys.exit(77)
    text = subprocess.run(["exrheader", path], check=True, capture_output=True, text=True).stdout
    for line in [
        "envmap (type envmap): cube-face map",
        "Z, 32-bit floating-point",
        "distance, 32-bit floating-point",
        "id, 32-bit unsigned integer",
        "compression (type compression): zip",
    ]:
        require(line in text, f"exrheader does not say '{line}'")


def main():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "known.exr")
        subprocess.run(
            [sys.argv[1], "--test-case=*the known map for independent readers*"],
            env={**os.environ, "ZSKEL_EXR_OUT": path}, check=True, stdout=subprocess.DEVNULL)
        file = oiio.ImageInput.open(path)
        require(file is not None, oiio.geterror())
        check_pixels(file)
        check_attributes(file.spec())
        file.close()
        check_header(path)
    print("OpenImageIO and exrheader read what was written")


main()
