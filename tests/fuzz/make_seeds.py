"""Small files of every form that the fuzzers begin from: make_seeds.py MODELS OUT writes OUT/TARGET/*."""

import json
import struct
import sys
import zlib
from pathlib import Path

STATIONS, PROFILE = 48, 16

TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
CUBE = (
    [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)],
    [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)],
)


def cut(shape):
    """Every polygon as a fan."""
    return shape[0], [(f[0], f[i - 1], f[i]) for f in shape[1] for i in range(2, len(f))]


def ring(around=6, across=3):
    """A coarse torus, whole numbers."""
    vertices = []
    for x, y in ((2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)):
        vertices += [(10 * x, 10 * y, -4), (16 * x, 16 * y, 0), (10 * x, 10 * y, 4)]
    faces = []
    for i in range(around):
        for k in range(across):
            a, b = i * across + k, i * across + (k + 1) % across
            c, d = (a + across) % len(vertices), (b + across) % len(vertices)
            faces += [(a, c, d), (a, d, b)]
    return vertices, faces


def words(numbers):
    return " ".join(str(n) for n in numbers)


def obj(shape):
    lines = ["# a comment", "o part", "vt 0 0", "vn 0 0 1"] + ["v " + words(v) for v in shape[0]]
    return "\n".join(lines + ["f " + words(f"{i + 1}/1/1" for i in f) for f in shape[1]]) + "\n"


def rows(shape, more=""):
    """Vertices and faces, one a line, as OFF and PLY have them."""
    vertices = "".join(f"{words(v)}{more}\n" for v in shape[0])
    return vertices + "".join(f"{len(f)} {words(f)}\n" for f in shape[1])


def off(shape, head="OFF", more=""):
    return f"{head}\n{len(shape[0])} {len(shape[1])} 0\n{rows(shape, more)}"


def ply(shape, form):
    vertices, faces = shape
    head = (
        f"ply\nformat {form} 1.0\ncomment made\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode()
    if form == "ascii":
        return head + rows(shape).encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(order + "3f", *v) for v in vertices)
    return head + body + b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)


def ascii_stl(shape):
    text = "solid part\n"
    for face in shape[1]:
        corners = "".join(f"vertex {words(shape[0][i])}\n" for i in face)
        text += f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"
    return text + "endsolid part\n"


def binary_stl(shape):
    facets = [struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in shape[0][i]), 0) for f in shape[1]]
    return bytes(80) + struct.pack("<I", len(facets)) + b"".join(facets)


PATCH = [[(x, y, (x - 1) * (y - 1)) for x in range(3)] for y in range(3)]


def bpt():
    return "1\n2 2\n" + "".join(words(p) + "\n" for row in PATCH for p in row)


def surfaces():
    nurbs = {
        "type": "nurbs",
        "degrees": [2, 1],
        "knots": [[0, 0, 0, 1, 2, 2, 2], [0, 0, 1, 1]],
        "points": [[[c, r, c * r, 1 + c] for c in range(4)] for r in range(2)],
    }
    turned = {"center": [1, 0, 0], "turn": 30, "axis": [1, 1, 0]}
    return [
        {"surfaces": [{"type": "bezier", "patches": [PATCH]}]},
        {"surfaces": [nurbs]},
        {"surfaces": [{"type": "superquadric", "radii": [1, 2, 3], "exponents": [1, 0.3], **turned}]},
    ]


NODES = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (2, 0.5, 0.25)]
EDGES = [(0, 1), (1, 2), (1, 3), (2, 3)]


def skeletons():
    nodes = [{"id": i, "position": p, "radius": 0.5, "volume": 1.5, "solid": 0} for i, p in enumerate(NODES)]
    edges = [{"source": a, "target": b} for a, b in EDGES]
    ours = {"format": "zskel-skeleton", "version": 1, "nodes": nodes, "edges": edges, "vertex_node": [0, 3, -1]}
    named = [{"id": f"n{i}", "x": x, "y": y, "z": z, "radius": 1} for i, (x, y, z) in enumerate(NODES)]
    links = [{"source": f"n{a}", "target": f"n{b}"} for a, b in EDGES]
    data = lambda x, y, z: "".join(f'<data key="{k}">{v}</data>' for k, v in (("x", x), ("y", y), ("z", z), ("r", 1)))
    keys = "".join(f'<key id="{k}" for="node" attr.name="{n}"/>' for k, n in zip("xyzr", ("x", "y", "z", "radius")))
    graphml = "".join(f'<node id="{i}">{data(*p)}</node>' for i, p in enumerate(NODES))
    graphml += "".join(f'<edge source="{a}" target="{b}"/>' for a, b in EDGES)
    array = lambda name, values: f'<DataArray Name="{name}" format="ascii">{words(values)}</DataArray>'
    points = array("Points", [x for p in NODES for x in p])
    radii = array("MaximumInscribedSphereRadius", [1] * len(NODES))
    lines = array("connectivity", [0, 1, 2, 3, 3, 1]) + array("offsets", [4, 6])
    ply_head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    ply_head += "property double radius\nelement edge 4\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    return {
        "skeleton_json": json.dumps(ours),
        "skeleton_nodelink": json.dumps({"nodes": named, "links": links, "edges": links, "graph": {}}),
        "skeleton_graphml": f'<?xml version="1.0"?><graphml>{keys}<graph edgedefault="undirected">{graphml}</graph></graphml>',
        "skeleton_swc": "# cut 3 4\n1 5 0 0 0 1 -1\n2 0 1 0 0 1 1\n3 6 1 1 0 1 2\n4 6 2 .5 .25 1 2\n",
        "skeleton_objlines": "".join(f"v {words(p)}\n" for p in NODES) + "l 1 2 3\nl -3 4\nl 3/1 4\n",
        "skeleton_ply": ply_head + "".join(words(p) + " 1\n" for p in NODES) + "".join(words(e) + "\n" for e in EDGES),
        "skeleton_vtp": f"<VTKFile><PolyData><Piece><PointData>{radii}</PointData><Points>{points}</Points>"
        f"<Lines>{lines}</Lines></Piece></PolyData></VTKFile>",
        "skeleton_polylines": "4 0 0 0 1 0 0 1 1 0 2 0.5 0.25\n2 1 0 0 2 0.5 0.25\n1 9 9 9\n",
    }


def map_node(face_px=4):
    texels = 6 * face_px * face_px
    return struct.pack("<3dI2f", 0, 0.5, 1, 0, 0.25, 4.0) + bytes(i % 256 for i in range(2 * texels))


def maps(face_px):
    packed = zlib.compress(map_node(face_px) * 2)
    return b"zskelmap" + struct.pack("<3IQ", 1, face_px, 2, len(packed)) + packed


def index():
    station = struct.pack(f"<I{2 * PROFILE + 1}f", 0, *(i / 16 for i in range(2 * PROFILE + 1)))
    shape = struct.pack("<I", 4) + b"name" + station * STATIONS
    return b"zskelidx" + struct.pack("<4I", 1, STATIONS, PROFILE, 2) + shape * 2


POSES = [
    {"moves": [{"branch": 0, "bend": 90, "axis": [0, 0, 1]}]},
    {"moves": [{"bone": "branch0.1", "turn": 20, "axis": [1, 0, 0], "begin": 1, "end": 2}]},
    {"moves": [{"near": [0.1, 0.8, 0.2], "twist": 30, "stretch": 1.2}]},
]


MANIFESTS = [
    "l{dir}/{stem}.json\na.obj\r\n# left out\n\nb/c d.ply\n",
    'c{stem}_{index}.json\nid,model,output\n7,a.obj,o.json\n"8","b ""q"".obj",\n',
    'jout/{id}.json\n{"model": "a.obj", "id": 3}\n{"model": "b.obj", "output": "o.json", "id": "x"}\n',
]


def journal():
    head = {"status": "ok", "reason": "", "exit_code": 0, "text": "", "warnings": ["w"]}
    tail = {"seconds": 0.5, "peak_memory_kib": 9, "backend": "cpu", "key": "0a"}
    lines = [{"model": f"{i}.obj", "output": f"{i}.json", **head, **tail} for i in range(2)]
    return "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in lines) + '{"model":"torn'


def packed_mesh(choice, shape, scale=0):
    """As chain_fuzz.cpp unpacks it."""
    vertices, faces = shape
    numbers = [int(x) % 256 for v in vertices for x in v] + [i for f in faces for i in f]
    return bytes([choice, len(vertices) - 3, scale, 0] + numbers)


def all_seeds(models):
    one_patch = "1\n" + "".join((models / "teapot.bpt").open().readlines()[1:18])
    small = cut(CUBE)
    wide = ([tuple(60 * x for x in v) for v in CUBE[0]], small[1])
    seeds = {
        "obj": [obj(TETRAHEDRON), obj(CUBE), (models / "cube_coarse.obj").read_bytes()],
        "off": [off(CUBE), off(TETRAHEDRON, "COFF", " 1 0 0 1"), off(small, "NOFF", " 0 0 1")],
        "ply": [ply(CUBE, f) for f in ("ascii", "binary_little_endian", "binary_big_endian")],
        "stl": [ascii_stl(small), binary_stl(small), binary_stl(TETRAHEDRON)],
        "bpt": [bpt(), one_patch],
        "surfacejson": [json.dumps(s) for s in surfaces()],
        "maps": [maps(4), maps(5), map_node() * 2],
        "index": [index()],
        "pose": [json.dumps(p) for p in POSES],
        "manifest": MANIFESTS,
        "journal": [journal()],
        "chain": [packed_mesh(c, s) for c in (0, 2, 4, 8, 16, 24) for s in (wide, ring(), TETRAHEDRON)]
        + [bytes([c]) + obj(s).encode() for c in (1, 3) for s in (CUBE, ring())],
    }
    return {**seeds, **{target: [text] for target, text in skeletons().items()}}


def main():
    models, out = Path(sys.argv[1]), Path(sys.argv[2])
    for target, files in all_seeds(models).items():
        folder = out / target
        folder.mkdir(parents=True, exist_ok=True)
        for number, content in enumerate(files):
            data = content if isinstance(content, bytes) else content.encode()
            (folder / f"seed{number:02}").write_bytes(data)


main()
