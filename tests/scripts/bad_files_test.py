"""Bad and odd model files: each gives a skeleton or an input error, and nothing else.

Usage: bad_files_test.py PROGRAM METHOD            files made here
       bad_files_test.py PROGRAM METHOD --shared   those in $ZSKEL_SHARED_MODELS/bad (none: says so, exit code 77)
"""

import json
import math
import os
import resource
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

FAST = ["--backend", "cpu", "--face-px", "4", "--with-seeds"]
FAST_OF_METHOD = {"paper": ["--step", "0.05", "--max-steps", "60"], "newton": []}
MEMORY_BYTES = 4 << 30  # of address space: what a small file may make the program ask for
SECONDS = 60
SECONDS_OF_FOLDER = 300
# Sanitizers reserve terabytes of address space.
HAS_MEMORY_LIMIT = "ZSKEL_SANITIZED" not in os.environ
SLOWER = 1 if HAS_MEMORY_LIMIT else 20


# ---- shapes: (vertices, faces) ----


def tube(sides=12, rings=20, length=4.0, radius=0.5):
    """Closed, outward; along x."""
    vertices = [
        (length * r / (rings - 1), radius * math.cos(angle), radius * math.sin(angle))
        for r in range(rings)
        for angle in (2 * math.pi * s / sides for s in range(sides))
    ]
    at = lambda r, s: r * sides + s % sides
    faces = []
    for r in range(rings - 1):
        for s in range(sides):
            faces.append((at(r, s), at(r, s + 1), at(r + 1, s + 1)))
            faces.append((at(r, s), at(r + 1, s + 1), at(r + 1, s)))
    for r, turned in ((0, True), (rings - 1, False)):
        centre = len(vertices)
        vertices.append((length * r / (rings - 1), 0.0, 0.0))
        for s in range(sides):
            rim = (at(r, s), at(r, s + 1))
            faces.append((centre,) + (rim[::-1] if turned else rim))
    return vertices, faces


TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def moved(shape, scale=1.0, offset=(0.0, 0.0, 0.0)):
    vertices, faces = shape
    return [tuple(x * scale + o for x, o in zip(v, offset)) for v in vertices], faces


def joined(*shapes):
    vertices, faces = [], []
    for part_vertices, part_faces in shapes:
        faces += [tuple(i + len(vertices) for i in face) for face in part_faces]
        vertices = vertices + list(part_vertices)
    return vertices, faces


def turned(shape, which=lambda i: True):
    return shape[0], [f[::-1] if which(i) else f for i, f in enumerate(shape[1])]


def soup(shape):
    vertices, faces = shape
    return [vertices[i] for f in faces for i in f], [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(faces))]


def mobius(count=40):
    vertices = []
    for i in range(count):
        t = 2 * math.pi * i / count
        for w in (-0.3, 0.3):
            r = 1 + w * math.cos(t / 2)
            vertices.append((r * math.cos(t), r * math.sin(t), w * math.sin(t / 2)))
    faces = []
    for i in range(count):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i + 1 < count else (1, 0)
        faces += [(a, c, b), (b, c, d)]
    return vertices, faces


def sheet(count=8):
    vertices = [(x, y, 0.0) for y in range(count) for x in range(count)]
    at = lambda x, y: y * count + x
    faces = []
    for y in range(count - 1):
        for x in range(count - 1):
            faces += [(at(x, y), at(x + 1, y), at(x + 1, y + 1)), (at(x, y), at(x + 1, y + 1), at(x, y + 1))]
    return vertices, faces


def obj(shape):
    lines = ["v " + " ".join(repr(float(x)) for x in v) for v in shape[0]]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in f) for f in shape[1]]) + "\n"


def off(shape):
    vertices, faces = shape
    lines = [f"OFF\n{len(vertices)} {len(faces)} 0"] + [" ".join(repr(float(x)) for x in v) for v in vertices]
    return "\n".join(lines + [f"{len(f)} " + " ".join(map(str, f)) for f in faces]) + "\n"


def ply_header(form, vertices, faces, kind="float", index="int"):
    return (
        f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty {kind} x\nproperty {kind} y\nproperty {kind} z\n"
        f"element face {faces}\nproperty list uchar {index} vertex_indices\nend_header\n"
    )


def ascii_ply(shape):
    vertices, faces = shape
    lines = [" ".join(repr(float(x)) for x in v) for v in vertices]
    lines += [f"{len(f)} " + " ".join(map(str, f)) for f in faces]
    return ply_header("ascii", len(vertices), len(faces)) + "\n".join(lines) + "\n"


def binary_ply(shape, order="<"):
    vertices, faces = shape
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    data = b"".join(struct.pack(order + "3f", *v) for v in vertices)
    data += b"".join(struct.pack(order + "B3i", 3, *f) for f in faces)
    return ply_header(form, len(vertices), len(faces)).encode() + data


def binary_stl(shape, count=None):
    vertices, faces = shape
    data = b" " * 80 + struct.pack("<I", len(faces) if count is None else count)
    for f in faces:
        data += struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in vertices[i]), 0)
    return data


def ascii_stl(shape):
    vertices, faces = shape
    text = "solid s\n"
    for f in faces:
        corners = "".join("vertex " + " ".join(repr(float(x)) for x in vertices[i]) + "\n" for i in f)
        text += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n"
    return text + "endsolid s\n"


# ---- the table: name, content, outcome ("fine", "warned", "error", "any": skeleton or error) ----


def shapes():
    t = tube()
    v, f = t
    yield "tube.obj", obj(t), "fine"
    yield "open.obj", obj((v, f[:-12])), "warned"
    yield "hole.obj", obj((v, f[:100] + f[103:])), "warned"
    yield "inside_out.obj", obj(turned(t)), "warned"
    yield "half_flipped.obj", obj(turned(t, lambda i: i % 2 == 0)), "warned"
    yield "soup.obj", obj(soup(t)), "any"
    yield "duplicate_faces.obj", obj((v, f + f[:50])), "warned"
    yield "all_faces_twice.obj", obj((v, f + f)), "warned"
    yield "opposite_duplicates.obj", obj((v, f + [g[::-1] for g in f[:50]])), "warned"
    yield "degenerate_faces.obj", obj((v, f + [(0, 0, 1), (5, 5, 5)])), "warned"
    middle = [tuple((a + b) / 2 for a, b in zip(v[0], v[1]))]
    yield "collinear_face.obj", obj((v + middle, f + [(0, len(v), 1)])), "warned"
    yield "edge_of_three.obj", obj((v + [(2, 5, 5)], f + [(0, 1, len(v))])), "warned"
    opposite = ([(-1, 0, 0), (0, -1, 0), (0, 0, -1)], [(0, 4, 5), (0, 6, 4), (0, 5, 6), (4, 6, 5)])
    two_fans = tuple(a + b for a, b in zip(TETRAHEDRON, opposite))
    yield "vertex_of_two_fans.obj", obj(two_fans), "any"
    yield "mobius.obj", obj(mobius()), "warned"
    yield "two_parts.obj", obj(joined(t, moved(t, 1.0, (0, 5, 0)))), "any"
    yield "far_parts.obj", obj(joined(t, moved(t, 1.0, (1e7, 0, 0)))), "any"
    yield "nested.obj", obj(joined(t, turned(moved(t, 0.5, (1, 0, 0))))), "any"
    yield "touching_parts.obj", obj(joined(t, moved(t, 1.0, (4, 0, 0)))), "any"
    yield "overlapping_parts.obj", obj(joined(t, moved(t, 1.0, (2, 0, 0)))), "any"
    yield "tiny.obj", obj(moved(t, 1e-9)), "fine"
    yield "huge.obj", obj(moved(t, 1e9)), "fine"
    yield "far_away.obj", obj(moved(t, 1.0, (1e6, 1e6, 1e6))), "fine"
    yield "too_far_away.obj", obj(moved(t, 1.0, (1e17, 0, 0))), "any"
    yield "subnormal.obj", obj(moved(t, 1e-310)), "any"
    yield "subnormal_square.obj", obj(moved(t, 1e-200)), "any"
    yield "near_the_limit.obj", obj(moved(t, 1e307)), "any"
    yield "square_overflows.obj", obj(moved(t, 1e200)), "any"
    yield "extent_overflows.obj", "v 1.7e308 0 0\nv -1.7e308 0 0\nv 0 1.7e308 0\nf 1 2 3\n", "any"
    yield "float_overflows.obj", obj(moved(t, 1e39)), "any"
    yield "mixed_scales.obj", obj(joined(t, moved(t, 1e-12, (2, 3, 0)))), "any"
    yield "one_triangle.obj", obj(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])), "warned"
    yield "two_sided_triangle.obj", obj(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2), (2, 1, 0)])), "any"
    yield "tetrahedron.obj", obj(TETRAHEDRON), "fine"
    yield "needle.obj", obj(([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1e-9)], TETRAHEDRON[1])), "any"
    yield "thread.obj", obj(tube(3, 20, 1.0, 1e-7)), "any"
    yield "sheet.obj", obj(sheet()), "warned"
    yield "thin_plate.obj", obj(joined(sheet(), turned(moved(sheet(), 1.0, (0, 0, 1e-6))))), "any"
    yield "unused_vertices.obj", obj((v + [(9, 9, 9), (-9, 0, 0)], f)), "any"
    yield "far_unused_vertex.obj", obj((v + [(1e300, 0, 0)], f)), "any"
    yield "all_at_one_place.obj", obj(([(1, 1, 1)] * 4, TETRAHEDRON[1])), "error"
    yield "all_on_a_line.obj", obj(([(i, 0, 0) for i in range(4)], TETRAHEDRON[1])), "error"
    yield "many_fans.obj", obj(([(0, 0, 0)] + [(math.cos(i), math.sin(i), 1) for i in range(100)],
                               [(0, i, i % 100 + 1) for i in range(1, 101)])), "warned"
    ring = [(math.cos(0.06 * i), math.sin(0.06 * i), z) for z in (0, 1) for i in range(100)]
    big = [tuple(range(99, -1, -1)), tuple(range(100, 200))]
    big += [(i, (i + 1) % 100, 100 + (i + 1) % 100, 100 + i) for i in range(100)]
    yield "polygons.obj", obj((ring, big)), "fine"
    yield "self_crossing_polygon.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "any"
    yield "tube.off", off(t), "fine"
    yield "tube.ply", ascii_ply(t), "fine"
    yield "binary.ply", binary_ply(t), "fine"
    yield "big_endian.ply", binary_ply(t, ">"), "fine"
    yield "tube.stl", ascii_stl(t), "fine"
    yield "binary.stl", binary_stl(t), "fine"


def obj_files():
    three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    yield "empty.obj", "", "error"
    yield "blank.obj", "\n\n# nothing\n", "error"
    yield "no_faces.obj", three, "error"
    yield "no_vertices.obj", "f 1 2 3\n", "error"
    indices = {
        "zero": "1 2 0", "past_the_end": "1 2 4", "negative_past": "-1 -2 -4", "word": "1 2 x", "fraction": "1 2 3.5",
        "two_corners": "1 2", "one_corner": "1", "no_corner": "", "slashes": "1/// 2 3",
        "2_to_32": "1 2 4294967297", "2_to_64": "1 2 18446744073709551617", "minus_2_to_63": "1 2 -9223372036854775808",
    }  # fmt: skip
    for name, face in indices.items():
        yield f"index_{name}.obj", three + f"f {face}\n", "error"
    numbers = {
        "nan": "nan", "inf": "inf", "minus_inf": "-inf", "overflow": "1e999", "word": "one", "hex": "0x1p3",
        "comma": "1,5", "missing": "",
    }  # fmt: skip
    for name, number in numbers.items():
        yield f"number_{name}.obj", three + f"v 0 0 {number}\nf 1 2 3\nf 1 2 4\n", "error"
    yield "long_number.obj", three + "v 0 0 " + "1" * 400 + "\nf 1 2 4\n", "error"
    yield "long_line.obj", obj(TETRAHEDRON) + "# " + "x" * 1000000 + "\n", "fine"
    yield "zero_bytes.obj", obj(TETRAHEDRON).replace("f", "\0f", 1), "error"
    yield "cut.obj", obj(tube())[:-30], "any"
    yield "utf16.obj", ("\ufeff" + obj(TETRAHEDRON)).encode("utf-16-le"), "error"
    yield "byte_order_mark.obj", "\ufeff".encode() + obj(TETRAHEDRON).encode(), "any"
    yield "carriage_returns.obj", obj(TETRAHEDRON).replace("\n", "\r"), "any"
    yield "binary.obj", bytes(range(256)) * 20, "error"
    yield "picture.obj", b"\x89PNG\r\n\x1a\n" + bytes(100), "error"
    yield "lines_and_points.obj", obj(TETRAHEDRON) + "l 1 2\np 3\n", "warned"
    yield "self_repeating_face.obj", obj(TETRAHEDRON) + "f 1 2 1 2\n", "any"


def off_files():
    good = off(TETRAHEDRON)
    yield "empty.off", "", "error"
    yield "only_magic.off", "OFF\n", "error"
    yield "zero_counts.off", "OFF\n0 0 0\n", "error"
    yield "no_magic.off", good[4:], "any"
    yield "wrong_magic.off", "OFFSET\n" + good[4:], "error"
    yield "binary_magic.off", "OFF BINARY\n" + good[4:], "error"
    yield "4e9_vertices.off", "OFF\n4000000000 4 0\n0 0 0\n", "error"
    yield "4e9_faces.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "error"
    yield "1e30_vertices.off", "OFF\n1000000000000000000000000000000 4 0\n", "error"
    yield "negative_count.off", "OFF\n-4 4 0\n", "error"
    yield "more_than_there.off", good.replace("4 4 0", "4 5 0"), "error"
    yield "fewer_than_there.off", good.replace("4 4 0", "4 3 0"), "any"
    yield "index_past_the_end.off", good.replace("3 1 2 3", "3 1 2 4"), "error"
    yield "negative_index.off", good.replace("3 1 2 3", "3 1 2 -1"), "error"
    yield "huge_face.off", good.replace("3 1 2 3", "4000000000 1 2 3"), "error"
    yield "two_corners.off", good.replace("3 1 2 3", "2 1 2"), "error"
    yield "nan.off", good.replace("1.0 0.0 0.0", "1.0 nan 0.0"), "error"
    for cut in (5, 12, 30, len(good) - 4):
        yield f"cut_at_{cut}.off", good[:cut], "error"


def ply_files():
    good, binary = ascii_ply(TETRAHEDRON), binary_ply(TETRAHEDRON)
    yield "empty.ply", "", "error"
    yield "only_magic.ply", "ply\n", "error"
    yield "no_end_header.ply", good.split("end_header")[0], "error"
    yield "unknown_format.ply", good.replace("ascii 1.0", "morse 1.0"), "error"
    yield "unknown_version.ply", good.replace("ascii 1.0", "ascii 9.0"), "error"
    yield "unknown_type.ply", good.replace("property float x", "property flat x"), "error"
    yield "no_coordinates.ply", good.replace("property float x", "property float q"), "error"
    yield "no_faces.ply", good.replace("element face 4", "element tail 4"), "error"
    yield "negative_count.ply", good.replace("vertex 4", "vertex -4"), "error"
    for kind, text in (("ascii", good.encode()), ("binary", binary)):
        yield f"4e9_vertices_{kind}.ply", text.replace(b"vertex 4", b"vertex 4000000000"), "error"
        yield f"2_to_64_faces_{kind}.ply", text.replace(b"face 4", b"face 18446744073709551617"), "error"
        yield f"1e18_faces_{kind}.ply", text.replace(b"face 4", b"face 1000000000000000000"), "error"
    yield "index_past_the_end.ply", good.replace("3 1 2 3", "3 1 2 4"), "error"
    yield "negative_index.ply", good.replace("3 1 2 3", "3 1 2 -1"), "error"
    yield "two_corners.ply", good.replace("3 1 2 3", "2 1 2"), "error"
    yield "list_of_vertices.ply", good.replace("property float x", "property list uchar float x"), "error"
    yield "float_index.ply", good.replace("uchar int", "uchar float"), "any"
    yield "float_count.ply", good.replace("uchar int", "float int"), "error"
    header = ply_header("binary_little_endian", 3, 1).replace("list uchar", "list int").encode()
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    yield "negative_list.ply", header + corners + struct.pack("<i3i", -3, 0, 1, 2), "error"
    yield "huge_list.ply", header + corners + struct.pack("<I3i", 0x7FFFFFFF, 0, 1, 2), "error"
    nan_corner = struct.pack("<f", math.nan) + corners[4:]
    yield "nan_binary.ply", header + nan_corner + struct.pack("<i3i", 3, 0, 1, 2), "error"
    yield "wrong_order.ply", binary.replace(b"binary_little", b"binary_big"), "error"
    for cut in (10, len(binary) // 2, len(binary) - 60, len(binary) - 1):
        yield f"cut_at_{cut}.ply", binary[:cut], "error"
    yield "more_behind.ply", binary + b"xyz", "any"
    many = "".join(f"property uchar p{i}\n" for i in range(300000))
    yield "many_properties.ply", good.replace("element face", many + "element face"), "error"


def stl_files():
    text, binary = ascii_stl(TETRAHEDRON), binary_stl(TETRAHEDRON)
    yield "empty.stl", "", "error"
    yield "no_triangles.stl", "solid s\nendsolid s\n", "error"
    yield "no_triangles_binary.stl", binary[:80] + bytes(4), "error"
    yield "4e9_triangles.stl", binary[:80] + struct.pack("<I", 4000000000) + binary[84:], "error"
    yield "one_more.stl", binary_stl(TETRAHEDRON, 5), "error"
    yield "one_fewer.stl", binary_stl(TETRAHEDRON, 3), "any"
    yield "short_header.stl", binary[:50], "error"
    yield "solid_binary.stl", b"solid" + binary[5:], "fine"
    yield "nan.stl", text.replace("vertex 1.0", "vertex nan"), "error"
    yield "nan_binary.stl", binary[:100] + struct.pack("<f", math.nan) + binary[104:], "error"
    yield "two_corners.stl", text.replace("vertex 0.0 0.0 0.0\n", "", 1), "error"
    yield "cut.stl", text[: len(text) // 2], "error"
    yield "cut_binary.stl", binary[:-20], "error"
    yield "zeros.stl", bytes(1000), "error"


def surface_files():
    patch = json.dumps([[(x, y, (x - 1) * (y - 1)) for x in range(3)] for y in range(3)])
    yield "patch.json", '{"surfaces": [{"type": "bezier", "patches": [%s]}]}' % patch, "warned"
    yield "not_finite.json", '{"surfaces": [{"type": "bezier", "patches": [%s]}]}' % patch.replace("2", "1e308"), "any"
    deep = "[" * 200000 + "]" * 200000
    yield "deep.json", '{"surfaces": %s}' % deep, "error"
    yield "deep_type.json", '{"surfaces": [{"type": %s}]}' % deep, "error"
    yield "far_patch.json", '{"surfaces": [{"type": "bezier", "patches": [%s]}]}' % patch.replace("2", "1e-300"), "any"
    # A spike in each of many patches asks for every step that there may be.
    spike = "3 3\n" + "".join(f"{c} {r} {1e6 if c == r == 1 else 0}\n" for r in range(4) for c in range(4))
    yield "spikes.bpt", "400\n" + spike * 399 + spike.replace("1000000.0", "1e12"), "any"


def other_files():
    yield "notes.txt", "hello\n", "error"
    yield "no_extension", obj(TETRAHEDRON), "fine"
    yield "ply_inside.obj", ascii_ply(TETRAHEDRON), "error"
    yield "wrong.xyz", off(TETRAHEDRON), "fine"


def made_files():
    for make in (shapes, obj_files, off_files, ply_files, stl_files, surface_files, other_files):
        yield from make()


# ---- running ----


def limits():
    if HAS_MEMORY_LIMIT:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program, arguments, seconds):
    """-> (exit code, standard output, standard error); the code is "timeout" when time was up."""
    settings = {"stdin": subprocess.DEVNULL, "capture_output": True, "preexec_fn": limits}
    try:
        done = subprocess.run([program, *arguments], timeout=seconds * SLOWER, **settings)
    except subprocess.TimeoutExpired:
        return "timeout", b"", b""
    return done.returncode, done.stdout, done.stderr


def finite(value):
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or math.isfinite(value)


def check_skeleton(skeleton):
    """What is wrong with a skeleton; empty when nothing is."""
    nodes, edges = skeleton["nodes"], skeleton["edges"]
    if not nodes:
        return "no node"
    for node in nodes:
        if len(node["position"]) != 3 or not finite(node["position"]) or not isinstance(node["radius"], (int, float)):
            return f"node {node}"
    if any(not 0 <= e[end] < len(nodes) for e in edges for end in ("source", "target")):
        return "an edge without its node"
    if any(not -1 <= n < len(nodes) for n in skeleton["vertex_node"]):
        return "a vertex without its node"
    if not all(finite(seed[end]) and None not in seed[end] for seed in skeleton["seeds"] for end in ("start", "end")):
        return "a seed that is nowhere"
    return ""


def judge(code, out, err, path, read):
    """-> (what came of it, what is wrong): `read` takes the parsed output of a run that went well."""
    if code == 0:
        try:
            document = json.loads(out, parse_constant=lambda name: float(name))
        except ValueError as broken:
            return "broken", f"exit code 0 without JSON: {broken}"
        if not finite(document):
            return "broken", "NaN or infinity in the JSON"
        return "skeleton", read(document)
    text = err.decode(errors="replace")
    if code != 3:
        return str(code), f"exit code {code}: {text.strip()[-200:]}"
    if out:
        return "error", "output beside an error"
    if text.count("\n") != 1 or os.path.basename(path) not in text:
        return "error", f"not one line that names the file: {text}"
    return "error", ""


def try_file(program, method, path, expected, seconds):
    """-> a row: (name, outcome, nodes, edges, note, what is wrong)."""
    kept = {}
    code, out, err = run(program, ["extract", path, "--method", method, *FAST, *FAST_OF_METHOD[method]], seconds)
    outcome, wrong = judge(code, out, err, path, lambda s: kept.update(skeleton=s) or check_skeleton(s))
    code, out, err_of_check = run(program, ["check", "--json", path], seconds)
    checked, wrong_check = judge(code, out, err_of_check, path, lambda r: kept.update(report=r) or "")
    wrong = wrong or wrong_check and f"check: {wrong_check}"
    # What can be looked at may still have no area; what cannot be read gives no skeleton.
    if not wrong and checked == "error" and outcome != "error":
        wrong = "extract takes what check cannot read"
    skeleton = kept.get("skeleton", {"nodes": [], "edges": [], "warnings": []})
    report = kept.get("report", {"defects": [], "vertices": 0})
    if not wrong and outcome == "skeleton" and len(skeleton["vertex_node"]) != report["vertices"]:
        wrong = "not every input vertex has its place in vertex_node"
    warnings = skeleton["warnings"]
    if not wrong and expected == "error" and outcome != "error":
        wrong = "this should be an input error"
    if not wrong and expected in ("fine", "warned") and outcome != "skeleton":
        wrong = f"this should give a skeleton: {err.decode(errors='replace').strip()}"
    if not wrong and expected == "warned" and not warnings:
        wrong = "this should give a warning"
    if not wrong and expected == "fine" and report["defects"]:
        wrong = f"a defect where there is none: {report['defects']}"
    said = err.decode(errors="replace").strip().replace(os.path.dirname(path) + "/", "")
    note = "; ".join(warnings) if outcome == "skeleton" else said
    return os.path.basename(path), outcome, len(skeleton["nodes"]), len(skeleton["edges"]), note, wrong


def run_table(program, method, files, seconds):
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = list(pool.map(lambda file: try_file(program, method, *file, seconds), files))
    print(f"{'file':<30} {'outcome':<9} {'nodes':>5} {'edges':>5}  warnings, error")
    for name, outcome, nodes, edges, note, wrong in rows:
        print(f"{name:<30} {outcome:<9} {nodes:>5} {edges:>5}  {note[:150]}")
        if wrong:
            print(f"    FAILED {wrong}")
    failed = sum(1 for row in rows if row[-1])
    print(f"{len(rows)} files, {failed} failures")
    return 1 if failed or not rows else 0


def main():
    program, method = os.path.abspath(sys.argv[1]), sys.argv[2]
    if sys.argv[3:] == ["--shared"]:
        folder = os.path.join(os.environ.get("ZSKEL_SHARED_MODELS", ""), "bad")
        if not os.path.isabs(folder) or not os.path.isdir(folder):
            print("skipped: ZSKEL_SHARED_MODELS names no folder with a folder 'bad'")
            return 77
        names = sorted(n for n in os.listdir(folder) if os.path.isfile(os.path.join(folder, n)))
        return run_table(program, method, [(os.path.join(folder, n), "any") for n in names], SECONDS_OF_FOLDER)
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for name, content, expected in made_files():
            path = os.path.join(folder, name)
            assert not os.path.exists(path), name
            with open(path, "wb") as file:
                file.write(content if isinstance(content, bytes) else content.encode())
            files.append((path, expected))
        return run_table(program, method, files, SECONDS)


if __name__ == "__main__":
    sys.exit(main())
