"""Random assemblies of shapes, nested, overlapping, squeezed, torn, flipped, noisy: `extract` with random options ends
with a skeleton, an input error or a limit, within a minute each; in no other way. A number names an assembly for good.

Usage: assemblies_test.py PROGRAM FIRST LAST
"""

import collections
import os
import subprocess
import sys
import tempfile

import numpy as np

SECONDS = 60
ANSWERS = {0: "skeleton", 3: "input error", 7: "limit"}
OPTIONS = [
    [],
    ["--join", "--join-voxel", "VOXEL"],
    ["--method", "paper", "--max-steps", "60"],
    ["--no-caps"],
    ["--no-repair"],
    ["--detail", "0.3"],
    ["--seeds", "all"],
]


# ---- shapes: (points, faces) of about n vertices a side ----


def grid(rows, columns, place, wraps):
    """`place(u, v)` at rows x columns values from 0 to 1, with quads cut in two between them."""
    at = lambda i, n, wrap: i / n if wrap else i / (n - 1)
    points = [
        place(at(i, rows, wraps[0]), at(j, columns, wraps[1])) for i in range(rows) for j in range(columns)
    ]
    faces = []
    for i in range(rows if wraps[0] else rows - 1):
        for j in range(columns if wraps[1] else columns - 1):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
            faces += [(a, c, b), (b, c, d)]
    return np.array(points), np.array(faces)


def sphere(n, rng):
    ring = lambda u, v: (
        np.sin(np.pi * u) * np.cos(2 * np.pi * v), np.sin(np.pi * u) * np.sin(2 * np.pi * v), np.cos(np.pi * u)
    )
    inner = lambda u, v: ring((1 + u * (n - 2)) / n, v)
    points, faces = grid(n - 1, 2 * n, inner, (False, True))
    count = len(points)
    around = np.arange(2 * n)
    after = np.roll(around, -1)
    last = count - 2 * n
    caps = np.concatenate([
        np.stack([np.full(2 * n, count), around, after], 1),
        np.stack([np.full(2 * n, count + 1), last + after, last + around], 1),
    ])
    return np.concatenate([points, [(0, 0, 1), (0, 0, -1)]]), np.concatenate([faces, caps])


def torus(n, rng):
    r = rng.uniform(0.05, 0.6)
    place = lambda u, v: (
        (1 + r * np.cos(2 * np.pi * v)) * np.cos(2 * np.pi * u),
        (1 + r * np.cos(2 * np.pi * v)) * np.sin(2 * np.pi * u),
        r * np.sin(2 * np.pi * v),
    )
    return grid(2 * n, n, place, (True, True))


def open_tube(n, rng):
    r, bend = 10 ** rng.uniform(-2.5, -0.3), rng.uniform(0, 10)
    place = lambda u, v: (
        r * np.cos(2 * np.pi * v) + 0.3 * np.sin(bend * u), r * np.sin(2 * np.pi * v), 4 * u - 2
    )
    return grid(2 * n, max(4, n // 2), place, (False, True))


def sheet(n, rng):
    wave = rng.choice([0.0, 0.3])
    return grid(n, n, lambda u, v: (2 * u - 1, 2 * v - 1, wave * np.sin(3 * u) * np.cos(2 * v)), (False, False))


def box(n, rng):
    points, faces = sphere(max(4, n // 2), rng)
    return points / np.abs(points).max(axis=1, keepdims=True), faces


def spiky(n, rng):
    points, faces = sphere(n, rng)
    points[rng.integers(len(points), size=rng.integers(1, 5))] *= rng.uniform(1, 8)
    return points, faces


def star(n, rng):
    points, faces = sphere(n, rng)
    return points * (1 + 0.8 * np.abs(np.sin(3 * points[:, :1]) * np.cos(4 * points[:, 1:2]))), faces


SHAPES = [sphere, torus, open_tube, sheet, box, spiky, star]


def turn(rng):
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def damaged(points, faces, rng):
    if rng.random() < 0.2:
        faces = faces[:, ::-1]
    if rng.random() < 0.2:
        faces = faces[rng.random(len(faces)) > 10 ** rng.uniform(-3, -0.5)]
    if rng.random() < 0.1 and len(faces):
        faces = np.concatenate([faces, faces[rng.integers(len(faces), size=5)]])
    if rng.random() < 0.1:
        points = points + rng.normal(size=points.shape) * 10 ** rng.uniform(-5, -1.5)
    if rng.random() < 0.1:
        points = np.round(points, rng.integers(1, 4))
    if rng.random() < 0.05 and len(faces):
        faces = faces.copy()
        faces[rng.integers(len(faces), size=3)] = rng.integers(len(points), size=(3, 3))
    if rng.random() < 0.05 and len(faces):
        points, faces = points[faces.reshape(-1)], np.arange(3 * len(faces)).reshape(-1, 3)
    return points, faces


def assembly(number):
    rng = np.random.default_rng(number)
    all_points, all_faces, count = [], [], 0
    for _ in range(rng.choice([1, 1, 2, 3, 5, 12])):
        points, faces = SHAPES[rng.integers(len(SHAPES))](int(rng.choice([3, 4, 6, 10, 20, 30])), rng)
        squeeze = 10 ** rng.uniform(-1.5, 0, size=3) if rng.random() < 0.4 else 1.0
        points = points * squeeze * 10 ** rng.uniform(-2.5, 0)
        points = points @ turn(rng).T + rng.uniform(-1, 1, 3) * rng.choice([0, 0.2, 1])
        points, faces = damaged(points, faces, rng)
        all_points.append(points)
        all_faces.append(faces + count)
        count += len(points)
    points = np.concatenate(all_points)
    scale = 1.0
    if rng.random() < 0.1:
        scale = 10 ** rng.uniform(-9, 9)
        points = points * scale + 10 ** rng.uniform(0, 6) * (rng.random() < 0.3)
    options = OPTIONS[rng.integers(len(OPTIONS))]
    return points, np.concatenate(all_faces), [o.replace("VOXEL", f"{0.02 * scale:g}") for o in options]


def main(program, first, last):
    answers = collections.Counter()
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "model.obj")
        for number in range(first, last):
            points, faces, options = assembly(number)
            with open(model, "w") as file:
                file.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
                file.writelines("f %d %d %d\n" % tuple(f + 1) for f in faces)
            command = [program, "-q", "--timeout", str(SECONDS), "extract", model, "-o", model + ".json", *options]
            try:
                done = subprocess.run(command, capture_output=True, text=True, timeout=2 * SECONDS)
                code, said = done.returncode, done.stderr[-300:]
            except subprocess.TimeoutExpired:
                code, said = None, "hangs"
            answers[code] += 1
            if code not in ANSWERS:
                wrong += 1
                print(f"assembly {number} {' '.join(options)}: exit code {code}: {said}", flush=True)
    print(", ".join(f"{ANSWERS.get(code, code)}: {count}" for code, count in answers.items()))
    return 1 if wrong else 0


sys.exit(main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3])))
