#!/usr/bin/env python3
"""Poses, tessellations and noise of our creatures: does `zskel match` find each one's own kind?

  tools/bench/retrieval.py ZSKEL [FOLDER]     (numpy)

Makes ten variants of each of nine creatures (nine bent at random branches by up to 50 degrees, turned and scaled; of those
three with noise and three with another tessellation, by reconstruct), extracts their skeletons, and prints nearest
neighbour, first tier and second tier, beside D2 shape distributions (Osada et al. 2002). Then the time to compare 1,000.
"""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

from obj_file import read_obj, write_obj

MODELS = pathlib.Path(__file__).resolve().parents[2] / "models"
CREATURES = ["horse", "bull", "frog", "mouse", "cobra", "octopus", "hand", "plant", "y"]
VARIANTS = 10
BEND_DEG = 50
NOISE = 0.0007  # of the longest side
VOXELS = 100
D2_PAIRS = 200_000
D2_BINS = 64


def run(*arguments):
    subprocess.run([str(a) for a in arguments], check=True)


def bent(program, model, branches, path, rng):
    """A random pose; branches without bones of their own are refused by name and left as they are."""
    moves = [{"branch": b, "bend": rng.uniform(-BEND_DEG, BEND_DEG), "axis": rng.normal(size=3).tolist()}
             for b in range(branches) if rng.random() < 0.6]
    pose = path.with_suffix(".pose")
    while True:
        pose.write_text(json.dumps({"moves": moves}))
        done = subprocess.run([program, "-q", "deform", model, "--backend", "cpu", "--pose", pose, "-o", path],
                              capture_output=True, text=True)
        if done.returncode == 0:
            return
        if "is not the number of a branch" not in done.stderr:
            sys.exit(done.stderr)
        number = int(done.stderr.split("branch: '")[1].split("'")[0])
        moves = [m for m in moves if m["branch"] != number]


def make_variant(program, name, k, branches, path, rng):
    if k == 0:
        write_obj(path, *read_obj(MODELS / f"{name}.obj"))
        return
    bent(program, MODELS / f"{name}.obj", branches, path, rng)
    vertices, faces = read_obj(path)
    longest = np.ptp(vertices, axis=0).max()
    if k % 3 == 2:
        other = path.with_suffix(".rebuilt.obj")
        run(program, "-q", "reconstruct", path, "--backend", "cpu", "--voxel", longest / VOXELS, "-o", other)
        vertices, faces = read_obj(other)
    if k % 3 == 1:
        vertices = vertices + rng.normal(scale=NOISE * longest, size=vertices.shape)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    write_obj(path, math.exp(rng.uniform(-2, 2)) * vertices @ turn.T, faces)


def d2(path, rng):
    """Distances of pairs of points spread over the surface, as shares of their mean."""
    vertices, faces = read_obj(path)
    corners = vertices[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = corners[rng.choice(len(faces), 2 * D2_PAIRS, p=area / area.sum())]
    u, v = np.sqrt(rng.random((2, len(chosen), 1)))[0], rng.random((len(chosen), 1))
    points = (1 - u) * chosen[:, 0] + u * (1 - v) * chosen[:, 1] + u * v * chosen[:, 2]
    apart = np.linalg.norm(points[:D2_PAIRS] - points[D2_PAIRS:], axis=1)
    return np.histogram(apart / apart.mean(), D2_BINS, (0, 3))[0] / D2_PAIRS


def scores(kinds, distances):
    nearest = first = second = 0.0
    for i, kind in enumerate(kinds):
        order = [j for j in np.argsort(distances[i], kind="stable") if j != i]
        same = [kinds[j] == kind for j in order]
        relevant = sum(same)
        nearest += same[0] / len(kinds)
        first += sum(same[:relevant]) / relevant / len(kinds)
        second += sum(same[:2 * relevant]) / relevant / len(kinds)
    return nearest, first, second


def main():
    program = os.path.abspath(sys.argv[1])
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp())
    skeletons = folder / "skeletons"
    skeletons.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(5)
    for name in CREATURES:
        whole = folder / f"{name}.json"
        run(program, "-q", "extract", MODELS / f"{name}.obj", "--backend", "cpu", "-o", whole)
        branches = len(json.loads(whole.read_text())["branches"])
        for k in range(VARIANTS):
            path = folder / f"{name}_{k}.obj"
            make_variant(program, name, k, branches, path, rng)
            run(program, "-q", "extract", path, "--backend", "cpu", "-o", skeletons / f"{name}_{k}.json")
    run(program, "match", "--index", skeletons, "--matrix", folder / "all.csv", "--dendrogram", folder / "all.svg")
    rows = list(csv.reader(open(folder / "all.csv")))[1:]
    names = [pathlib.Path(r[0]).stem for r in rows]
    kinds = [n.rsplit("_", 1)[0] for n in names]
    ours = np.array([[float(x) for x in r[1:]] for r in rows])
    histograms = np.array([d2(folder / f"{n}.obj", rng) for n in names])
    theirs = np.abs(histograms[:, None] - histograms[None]).sum(axis=2)
    print(f"{len(names)} shapes of {len(CREATURES)} kinds       nearest   first tier   second tier")
    for label, distances in (("zskel match", ours), ("D2", theirs)):
        print("%-28s %8.3f %12.3f %13.3f" % ((label,) + scores(kinds, distances)))
    # The same skeletons under other names, to a thousand.
    many = folder / "many"
    many.mkdir(exist_ok=True)
    sources = sorted(skeletons.glob("*.json"))
    for i in range(1000):
        link = many / f"{i:04}.json"
        if not link.exists():
            os.link(sources[i % len(sources)], link)
    index = folder / "many.idx"
    start = time.perf_counter()
    run(program, "match", "--index", many, "--store", index)
    print(f"1,000 skeletons read and stored: {time.perf_counter() - start:.2f} s")
    start = time.perf_counter()
    subprocess.run([program, "match", "--index", index, "--query", sources[0]], check=True, capture_output=True)
    print(f"one query among 1,000 stored: {time.perf_counter() - start:.2f} s")


if __name__ == "__main__":
    main()
