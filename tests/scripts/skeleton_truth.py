"""What the tests of the skeleton formats have in common: skeletons whose values are known, in every form."""

import json
import os
import subprocess
import sys
import tempfile


def leave_out(missing):
    """Ends the test that lacks a reader."""
    print(f"{missing} (on Debian: tools/setup --long)")
    sys.exit(1 if os.environ.get("ZSKEL_REQUIRE_READERS") == "1" else 77)


try:
    import numpy as np
except ImportError as numpy_missing:
    leave_out(numpy_missing)

PROGRAM, MODELS = sys.argv[1:]
# A loop at a junction, a ring of its own, a lone node, two solids, and numbers that need all their digits.
ODD = {
    "positions": [(0.1, -1 / 3, 1e-17), (1, 0, 0), (2, 1e-3, 0.25), (2, -4, 3.3), (-7, 5, -5), (10, 0, 0), (11, 0, 0),
                  (10.5, 1, 0)],
    "radii": [0.1, 0.5, 0.25, 0, 2**0.5, 0.3, 0.2, 0.4],
    "edges": [(0, 1), (1, 2), (1, 3), (2, 3), (5, 6), (5, 7), (6, 7)],
    "pieces": 4,  # tubes: 0-1, the loop 1-2-3-1, the ring, the lone node
}


def require(fine, what):
    if not fine:
        sys.exit(f"formats_test: {what}")


def zskel(*arguments):
    return subprocess.run([PROGRAM, "-q", *arguments], check=True, capture_output=True).stdout


class Truth:
    """A skeleton from our JSON, as arrays."""

    def __init__(self, path):
        self.path = path
        with open(path) as file:
            self.data = json.load(file)
        nodes = self.data["nodes"]
        self.points = np.array([n["position"] for n in nodes])
        self.radii = np.array([n["radius"] for n in nodes])
        self.volumes = np.array([n["volume"] for n in nodes])
        self.solids = np.array([n["solid"] for n in nodes])
        self.edges = {(e["source"], e["target"]) for e in self.data["edges"]}
        self.lengths = {e: float(np.linalg.norm(self.points[e[0]] - self.points[e[1]])) for e in self.edges}
        self.size = float(np.ptp(self.points, axis=0).max())
        degrees = np.bincount(np.array(list(self.edges)).ravel(), minlength=len(nodes))
        self.lone = int((degrees == 0).sum())

    def written(self, extension, *options):
        """The path of the same skeleton in another form."""
        out = f"{self.path[:-5]}{'-'.join(('',) + options)}{extension}"
        zskel("convert", self.path, "-o", out, *options)
        return out

    def numbers_at(self, points):
        """The node at each of these places, all digits equal."""
        numbers = {tuple(p): i for i, p in enumerate(self.points)}
        require(all(tuple(p) in numbers for p in points), "a point that is no node's")
        return [numbers[tuple(p)] for p in points]


def as_edges(pairs):
    edges = [tuple(sorted(map(int, pair))) for pair in pairs]
    require(len(set(edges)) == len(edges), "an edge twice")
    return set(edges)


def make_odd(folder):
    path = os.path.join(folder, "odd.json")
    nodes = [{"id": i, "position": p, "radius": r, "volume": 1 / (i + 7), "solid": i // 5}
             for i, (p, r) in enumerate(zip(ODD["positions"], ODD["radii"]))]
    edges = [{"source": a, "target": b} for a, b in ODD["edges"]]
    with open(path, "w") as file:
        json.dump({"format": "zskel-skeleton", "version": 1, "nodes": nodes, "edges": edges}, file)
    zskel("convert", path, "-o", path[:-8] + "whole.json")  # with branches
    return Truth(path[:-8] + "whole.json")


def make_extracted(folder):
    """Two handles; written by extract itself, in each form, over and over the same skeleton."""
    path = os.path.join(folder, "torus.json")
    model = os.path.join(MODELS, "double_torus.obj")
    options = ["--backend", "ray", "--seeds", "200"]
    zskel("extract", model, *options, "-o", path)
    truth = Truth(path)
    require(len(truth.edges) > 20 and len(truth.edges) == len(truth.points) + 1, "the skeleton of a double torus")
    for extension in ("graphml", "swc", "obj", "ply", "vtp", "polylines.txt", "gltf", "glb"):
        direct = f"{path[:-5]}.direct.{extension}"
        extra = ["--correspondence", path[:-5] + ".correspondence"] if extension == "polylines.txt" else []
        zskel("extract", model, *options, "-o", direct, *extra)
        converted = truth.written("." + extension)
        with open(direct, "rb") as a, open(converted, "rb") as b:
            # They differ in the command that is told, if at all.
            require(abs(len(a.read()) - len(b.read())) < 1000, f"extract and convert differ in {extension}")
    check_correspondence(truth, path[:-5] + ".correspondence", model)
    return truth


def check_correspondence(truth, path, model):
    with open(model) as file:
        vertices = [tuple(map(float, line.split()[1:4])) for line in file if line.startswith("v ")]
    rows = np.loadtxt(path)
    require(rows.shape == (len(vertices), 7) and (rows[:, 0] == 2).all(), "the correspondence's shape")
    require(np.array_equal(rows[:, 4:], np.array(vertices)), "the correspondence's surface points")
    require(truth.numbers_at(rows[:, 1:4]) == truth.data["vertex_node"], "the correspondence's nodes")


def run_checks(*checks):
    """Each check on each skeleton."""
    with tempfile.TemporaryDirectory() as folder:
        odd = make_odd(folder)
        require(len(odd.data["branches"]) + odd.lone == ODD["pieces"], "the branches of the odd skeleton")
        for truth in (odd, make_extracted(folder)):
            for check in checks:
                check(truth)
    print("every reader found what was written")
