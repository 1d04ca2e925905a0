"""Our models with defects put in, alone and in pairs: each gives a skeleton or an input error; at least 95 % give
the clean model's skeleton, and those that do not say in a warning that they may be wrong: one that is more than the
count of a repair that changes no shape. Prints a table by defect.

Usage: dirty_meshes_test.py PROGRAM MODELS [--cgal PROGRAM] [MODEL...]
  --cgal  prints, beside ours, how many of the same files the benchmark's CGAL program gets right
"""

import itertools
import json
import os
import random
import subprocess
import sys
import tempfile
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor

import numpy as np

NAMES = ["horse", "octopus", "hand", "y", "torus", "cobra"]
DISTANCE = 0.01  # of the diagonal: mean distance to the clean model's skeleton
SHARE = 0.95
SECONDS = 120
PEER_SECONDS = 10
SHAPE_STAYS = (  # warnings that say nothing against a skeleton
    "vertices welded to another at the same position",
    "vertices without a face",
    "faces without area",
    "duplicate faces",
    "faces turned",
    "inside-out components turned",
)


class Chance(random.Random):
    """Random numbers, and where the clean model is thickest: the place and its radius."""

    deep = (np.zeros(3), 0.0)


def read_obj(path):
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append(tuple(int(w.split("/")[0]) - 1 for w in words[1:]))
    return np.array(vertices), faces


def obj_text(vertices, faces):
    lines = ["v %r %r %r" % tuple(map(float, v)) for v in vertices]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in f) for f in faces]) + "\n"


def diagonal(vertices):
    return float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))


# ---- defects: (vertices, faces, random) -> (vertices, faces); scale and offset also say how ----


def soup(v, f, rng):
    return np.array([v[i] for face in f for i in face]), [
        tuple(range(start, start + len(face)))
        for start, face in zip(itertools.accumulate([0] + [len(face) for face in f[:-1]]), f)
    ]


def cracked(v, f, rng):
    v, f = soup(v, f, rng)
    noise = np.random.default_rng(rng.randrange(1 << 30)).uniform(-1.0, 1.0, v.shape)
    return v + noise * 1e-6 * diagonal(v), f


def half_flipped(v, f, rng):
    return v, [face[::-1] if rng.random() < 0.5 else face for face in f]


def inside_out(v, f, rng):
    return v, [face[::-1] for face in f]


def duplicates(v, f, rng):
    return v, f + rng.sample(f, len(f) // 20)


def degenerate(v, f, rng):
    some = rng.sample(f, len(f) // 20)
    return v, f + [(a[0], a[1], a[0]) for a in some]


def holes(v, f, rng):
    gone = set(rng.sample(range(len(f)), len(f) // 50))
    return v, [face for i, face in enumerate(f) if i not in gone]


def fins(v, f, rng):
    some = rng.sample(f, 10)
    tips = [(v[a[0]] + v[a[1]]) / 2 + 0.02 * diagonal(v) * np.array([rng.uniform(-1, 1) for _ in range(3)]) for a in some]
    return np.vstack([v, tips]), f + [(a[0], a[1], len(v) + i) for i, a in enumerate(some)]


def t_junctions(v, f, rng):
    v, f = list(v), list(f)
    for i in rng.sample(range(len(f)), len(f) // 20):
        a, b, c = f[i][:3]
        if len(f[i]) != 3:
            continue
        v.append((v[a] + v[b]) / 2)
        f[i] = (a, len(v) - 1, c)
        f.append((len(v) - 1, b, c))
    return np.array(v), f


def loose_vertices(v, f, rng):
    return np.vstack([v, v.min(axis=0) - diagonal(v), v.mean(axis=0)]), f


def shuffled(v, f, rng):
    order = list(range(len(v)))
    rng.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    f = [tuple(place[i] for i in face) for face in f]
    rng.shuffle(f)
    return v[order], f


def polygons(v, f, rng):
    by_edge = {}
    for i, face in enumerate(f):
        for k in range(len(face)):
            by_edge[face[k], face[(k + 1) % len(face)]] = i
    gone, out = set(), []
    for i, face in enumerate(f):
        if i in gone:
            continue
        other = by_edge.get((face[1], face[0]))
        if len(face) == 3 and other is not None and other > i and other not in gone and len(f[other]) == 3:
            normals = [np.cross(v[g[1]] - v[g[0]], v[g[2]] - v[g[0]]) for g in (face, f[other])]
            lengths = [np.linalg.norm(n) for n in normals]
            if min(lengths) > 0 and normals[0] @ normals[1] > 0.98 * lengths[0] * lengths[1]:
                apex = next(c for c in f[other] if c not in face)
                out.append((face[0], apex, face[1], face[2]))
                gone.add(other)
                continue
        out.append(face)
    return v, out


def opening(v, f, rng):
    """The outermost of one side is cut off."""
    ahead = np.array([rng.gauss(0.0, 1.0) for _ in range(3)])
    along = v @ (ahead / np.linalg.norm(ahead))
    limit = along.max() - 0.01 * diagonal(v)
    return v, [face for face in f if max(along[i] for i in face) < limit]


def self_crossing(v, f, rng):
    """Corners pushed past a neighbour and in, through the faces beyond it."""
    v = v.copy()
    for face in rng.sample(f, 10):
        a, b, c = (v[i] for i in face[:3])
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length > 0.0:
            v[face[0]] = b + (b - a) - normal / length * 0.5 * np.linalg.norm(b - a)
    return v, f


def ball(place, radius):
    """Of 80 faces."""
    g = (1.0 + 5.0**0.5) / 2.0
    v = [p for a in (-1, 1) for b in (-g, g) for p in ((0, a, b), (a, b, 0), (b, 0, a))]
    v = [np.array(p) / np.linalg.norm(p) for p in v]
    near = 1.1 * min(np.linalg.norm(v[0] - p) for p in v[1:])
    f = [
        (i, j, k) if np.dot(np.cross(v[j] - v[i], v[k] - v[i]), v[i]) > 0 else (i, k, j)
        for i, j, k in itertools.combinations(range(12), 3)
        if max(np.linalg.norm(v[i] - v[j]), np.linalg.norm(v[j] - v[k]), np.linalg.norm(v[k] - v[i])) < near
    ]
    middle = {}

    def between(a, b):
        key = min(a, b), max(a, b)
        if key not in middle:
            middle[key] = len(v)
            v.append((v[a] + v[b]) / np.linalg.norm(v[a] + v[b]))
        return middle[key]

    finer = []
    for a, b, c in f:
        x, y, z = between(a, b), between(b, c), between(c, a)
        finer += [(a, x, z), (x, b, y), (z, y, c), (x, y, z)]
    return np.array(v) * radius + place, finer


def with_part(v, f, part):
    return np.vstack([v, part[0]]), f + [tuple(i + len(v) for i in face) for face in part[1]]


def nested(v, f, rng):
    """A bubble where it is thickest."""
    place, radius = rng.deep
    v2, f2 = ball(place + 0.4 * radius, 0.15 * radius)
    return with_part(v, f, (v2, [face[::-1] for face in f2]))


def overlapping(v, f, rng):
    """A second part that sticks out of the first a little: --join makes one of them."""
    place, radius = rng.deep
    return with_part(v, f, ball(place, 1.1 * radius))


def sheet(v, f, rng):
    """A leaf beside the model, with an edge to no one."""
    side = 0.1 * diagonal(v)
    corner = v.max(axis=0) + 0.2 * diagonal(v)
    leaf = [corner + side * np.array([x, y, 0.0]) for x in (0, 1, 2) for y in (0, 1, 2)]
    cells = [(3 * x + y, 3 * x + y + 3, 3 * x + y + 4, 3 * x + y + 1) for x in (0, 1) for y in (0, 1)]
    return with_part(v, f, (np.array(leaf), cells))


def tiny(v, f, rng):
    return v * 1e-9, f


def huge(v, f, rng):
    return v * 1e9, f


def far_away(v, f, rng):
    return v + 1e6, f


DEFECTS = [soup, cracked, half_flipped, inside_out, duplicates, degenerate, holes, fins, t_junctions, loose_vertices,
           shuffled, polygons, opening, self_crossing, nested, overlapping, sheet, tiny, huge, far_away]  # fmt: skip
PLACED = {tiny, huge, far_away}  # come last: other defects go by sizes
FIRST = {opening, nested, overlapping, sheet}  # go by the clean model's places
OPTIONS = {overlapping: ["--join"]}
SURE = {tiny: lambda p: p / 1e-9, huge: lambda p: p / 1e9, far_away: lambda p: p - 1e6}


def pairs():
    for a, b in itertools.combinations(DEFECTS, 2):
        if a in PLACED and b in PLACED or soup in (a, b) and cracked in (a, b):
            continue
        if overlapping in (a, b):  # --join takes a closed surface's inside for granted; alone only
            continue
        yield (a, b)


# ---- skeletons ----


def curve(nodes, edges):
    if not len(edges):
        return nodes
    steps = np.linspace(0.0, 1.0, 6)
    return np.vstack([nodes[a] + np.outer(steps, nodes[b] - nodes[a]) for a, b in edges])


def mean_distance(a, b):
    def one_way(p, q):
        return float(np.mean([np.sqrt(((q - x) ** 2).sum(axis=1).min()) for x in p[:: max(1, len(p) // 400)]]))

    return 0.5 * (one_way(a, b) + one_way(b, a))


def skeleton_of(document):
    nodes = np.array([n["position"] for n in document["nodes"]])
    edges = [(e["source"], e["target"]) for e in document["edges"]]
    return nodes, edges


def components(nodes, edges):
    root = list(range(len(nodes)))

    def find(i):
        while root[i] != i:
            root[i] = root[root[i]]
            i = root[i]
        return i

    for a, b in edges:
        root[find(a)] = find(b)
    return len({find(i) for i in range(len(nodes))})


def is_like(skeleton, clean, size):
    (nodes, edges), (clean_nodes, clean_edges) = skeleton, clean
    parts, clean_parts = components(nodes, edges), components(clean_nodes, clean_edges)
    if parts != clean_parts or len(edges) - len(nodes) + parts != len(clean_edges) - len(clean_nodes) + clean_parts:
        return False
    return mean_distance(curve(nodes, edges), curve(clean_nodes, clean_edges)) <= DISTANCE * size


def back(skeleton, defects, clean_vertices):
    nodes, edges = skeleton
    for defect in defects:
        if defect in SURE:
            nodes = SURE[defect](nodes)
    if sheet in defects:  # what lies on the leaf is the leaf's
        limit = clean_vertices.max(axis=0) + 0.1 * diagonal(clean_vertices)
        kept = [i for i, p in enumerate(nodes) if not (p > limit).all()]
        number = {old: new for new, old in enumerate(kept)}
        nodes = nodes[kept]
        edges = [(number[a], number[b]) for a, b in edges if a in number and b in number]
    return nodes, edges


def extract(program, path, out, options=()):
    """Exit code, document or none, what was said."""
    command = [program, "--threads", "1", "extract", path, "-o", out, "--backend", "cpu", *options]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, errors="replace")
    except subprocess.TimeoutExpired:
        return 124, None, "hangs"
    document = json.load(open(out)) if done.returncode == 0 else None
    return done.returncode, document, done.stderr.strip().splitlines()[-1:]


def cgal(program, path, out):
    try:
        done = subprocess.run([program, "-q", "extract", path, "-o", out], capture_output=True, timeout=PEER_SECONDS)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0 or not os.path.exists(out):
        return None
    document = json.load(open(out))
    return np.array(document["nodes"], dtype=float).reshape(-1, 3), document["edges"]


def main():
    arguments = sys.argv[1:]
    peer = None
    if "--cgal" in arguments:
        at = arguments.index("--cgal")
        peer = arguments[at + 1]
        del arguments[at : at + 2]
    program, models = arguments[:2]
    names = arguments[2:] or NAMES
    cases = [(name, (d,)) for name in names for d in DEFECTS]
    both = [(name, pair) for pair in pairs() for name in names]
    random.Random(1).shuffle(both)
    cases += both[: max(0, 300 - len(cases))]
    with tempfile.TemporaryDirectory() as folder:
        clean = {}
        for name in names:
            code, document, said = extract(program, f"{models}/{name}.obj", f"{folder}/{name}.json")
            assert code == 0, (name, said)
            vertices, faces = read_obj(f"{models}/{name}.obj")
            thickest = max(document["nodes"], key=lambda n: n["radius"])
            deep = (np.array(thickest["position"]), thickest["radius"])
            clean[name] = (vertices, faces, skeleton_of(document), deep)

        def run(case):
            number, (name, defects) = case
            vertices, faces, skeleton, deep = clean[name]
            rng = Chance(number)
            rng.deep = deep
            for defect in sorted(defects, key=lambda d: (d not in FIRST, d in PLACED)):
                vertices, faces = defect(vertices, faces, rng)
            path = f"{folder}/{number}.obj"
            with open(path, "w") as file:
                file.write(obj_text(vertices, faces))
            options = [o for defect in defects for o in OPTIONS.get(defect, [])]
            code, document, said = extract(program, path, f"{folder}/{number}.json", options)
            size = diagonal(clean[name][0])
            right = document is not None and is_like(
                back(skeleton_of(document), defects, clean[name][0]), skeleton, size
            )
            theirs = cgal(peer, path, f"{folder}/{number}.cgal.json") if peer else None
            peer_right = theirs is not None and is_like(
                back(theirs, defects, clean[name][0]), skeleton, 3 * size
            )
            return name, defects, code, document, said, right, peer_right

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(run, enumerate(cases)))

    failures = []
    rows = defaultdict(lambda: [0, 0, 0, 0])
    for name, defects, code, document, said, right, peer_right in results:
        label = f"{name}: {' and '.join(d.__name__ for d in defects)}"
        if code not in (0, 3):
            failures.append(f"{label}: exit code {code}, {said}")
        if code == 0 and not right:
            warnings = document["warnings"]
            print(f"not the clean skeleton: {label}; warnings: {warnings}")
            if all(w.startswith(SHAPE_STAYS) for w in warnings):
                failures.append(f"{label}: wrong without a word")
        for defect in defects:
            row = rows[defect.__name__]
            for k, what in enumerate((1, right, code == 3, peer_right)):
                row[k] += int(what)
    print(f"{'defect':16} {'files':>6} {'right':>6} {'refused':>8}" + (f" {'CGAL':>6}" if peer else ""))
    for defect, row in rows.items():
        print(f"{defect:16} {row[0]:6} {row[1]:6} {row[2]:8}" + (f" {row[3]:6}" if peer else ""))
    right = sum(r[5] for r in results)
    print(f"{right} of {len(results)} right" + (f", CGAL {sum(r[6] for r in results)}" if peer else ""))
    if right < SHARE * len(results):
        failures.append(f"only {right} of {len(results)} right")
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
