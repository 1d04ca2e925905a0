#!/usr/bin/env python3
"""How long `zskel rig` takes on a model of 100,000 faces and more: our horse, every face cut into four until it has so many.

  tools/bench/rig.py ZSKEL     (numpy)

Prints faces, and the best and worst of five whole processes.
"""
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

from obj_file import read_obj, write_obj

HORSE = pathlib.Path(__file__).resolve().parents[2] / "models" / "horse_8k.obj"
LEAST_FACES = 100_000
ROUNDS = 5


def cut(vertices, faces):
    sides = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    middle = len(vertices) + number.reshape(-1, 3)
    a, b, c = faces.T
    ab, bc, ca = middle.T
    four = np.stack([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))], 1)
    return np.vstack([vertices, vertices[edges].mean(axis=1)]), four.reshape(-1, 3)


def main():
    vertices, faces = read_obj(HORSE)
    while len(faces) < LEAST_FACES:
        vertices, faces = cut(vertices, faces)
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder) / "horse.obj"
        write_obj(model, vertices, faces)
        seconds = []
        for _ in range(ROUNDS):
            start = time.perf_counter()
            subprocess.run([sys.argv[1], "-q", "rig", model, "-o", model.with_suffix(".glb")], check=True)
            seconds.append(time.perf_counter() - start)
    print(f"rig of {len(faces)} faces: {min(seconds):.2f} s at best, {max(seconds):.2f} s at worst")


if __name__ == "__main__":
    main()
