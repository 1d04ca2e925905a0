"""Reads skeletons with programs that share no code with ours, and compares all values with the JSON: NetworkX, NumPy
and Python's own JSON.

Usage: formats_test.py PROGRAM MODELS_DIR   (exit code 77: a reader is not installed)
"""

import base64
import json
import struct

from skeleton_truth import as_edges, leave_out, require, run_checks, zskel

try:
    import networkx as nx
    import numpy as np
except ImportError as missing:
    leave_out(missing)


def check_networkx_graph(truth, graph, what):
    require(not graph.is_directed() and not graph.is_multigraph(), f"{what}: no simple graph")
    require(sorted(graph) == list(range(len(truth.points))), f"{what}: the nodes' names")
    require(as_edges(graph.edges) == truth.edges, f"{what}: the edges")
    for n, data in graph.nodes(data=True):
        require((data["x"], data["y"], data["z"]) == tuple(truth.points[n]), f"{what}: the place of {n}")
        require(data["radius"] == truth.radii[n] and data["volume"] == truth.volumes[n], f"{what}: a value of {n}")
        require(data["solid"] == truth.solids[n] and isinstance(data["solid"], int), f"{what}: the solid of {n}")
    for a, b, length in graph.edges(data="length"):
        require(abs(length - truth.lengths[min(a, b), max(a, b)]) <= 1e-12 * truth.size, f"{what}: a length")


def check_networkx(truth):
    with open(truth.written(".nl.json", "--node-link")) as file:
        data = json.load(file)
    old = {k: v for k, v in data.items() if k != "edges"}
    new = {k: v for k, v in data.items() if k != "links"}
    for form in (data, old):
        check_networkx_graph(truth, nx.node_link_graph(form, link="links"), "node-link, links")
    for form in (data, new):
        check_networkx_graph(truth, nx.node_link_graph(form, link="edges"), "node-link, edges")
    check_networkx_graph(truth, nx.node_link_graph(data), "node-link, by default")
    graph = nx.read_graphml(truth.written(".graphml"), node_type=int)
    check_networkx_graph(truth, graph, "GraphML")
    # And back: what NetworkX writes is read.
    back = truth.path[:-5] + ".networkx.graphml"
    nx.write_graphml(graph, back)
    zskel("convert", back, "-o", back + ".json")
    with open(back + ".json") as file:
        again = json.load(file)
    require(again["nodes"] == truth.data["nodes"] and again["edges"] == truth.data["edges"], "NetworkX's GraphML")
    with open(back + ".json", "w") as file:
        json.dump(nx.node_link_data(graph), file)
    require(json.loads(zskel("convert", back + ".json"))["nodes"] == truth.data["nodes"], "NetworkX's node-link")


def check_swc(truth):
    path = truth.written(".swc")
    rows = np.loadtxt(path, ndmin=2)
    ids, parents = rows[:, 0].astype(int), rows[:, 6].astype(int)
    require(np.array_equal(ids, np.arange(1, len(truth.points) + 1)), "SWC: the ids")
    require((parents < ids).all() and ((parents > 0) | (parents == -1)).all(), "SWC: parents first")
    nodes = truth.numbers_at(rows[:, 2:5])
    require(sorted(nodes) == list(range(len(nodes))), "SWC: every node once")
    require(np.array_equal(rows[:, 5], truth.radii[nodes]), "SWC: the radii")
    with open(path) as file:
        cuts = [tuple(map(int, line.split()[2:])) for line in file if line.startswith("# cut ")]
    tree = [(i, p) for i, p in zip(ids, parents) if p > 0]
    require(as_edges((nodes[a - 1], nodes[b - 1]) for a, b in tree + cuts) == truth.edges, "SWC: edges and cuts")
    forest = nx.Graph(as_edges((nodes[a - 1], nodes[b - 1]) for a, b in tree))
    forest.add_nodes_from(nodes)
    require(nx.is_forest(forest), "SWC: a cycle")
    for a, b in cuts:
        way = nx.shortest_path(forest, nodes[a - 1], nodes[b - 1])
        longest = max(truth.lengths[min(e), max(e)] for e in zip(way, way[1:]))
        cut = truth.lengths[tuple(sorted((nodes[a - 1], nodes[b - 1])))]
        require(cut >= longest, "SWC: a cut that is not at the longest edge of its cycle")
    for component in nx.connected_components(forest):
        roots = [n for n in component if parents[nodes.index(n)] == -1]
        require(len(roots) == 1, "SWC: one root for each component")
        require(truth.radii[roots[0]] == max(truth.radii[list(component)]), "SWC: a root that is not the thickest")
    types = {1: 6, 2: 0, 0: 0}
    require(all(t == types.get(forest.degree[n], 5) for t, n in zip(rows[:, 1], nodes)), "SWC: the types")


def check_polylines(truth):
    with open(truth.written(".polylines.txt")) as file:
        lines = [line.split() for line in file]
    found = []
    for words in lines:
        require(len(words) == 1 + 3 * int(words[0]), "polylines: a count")
        found.append(truth.numbers_at(np.array(words[1:], dtype=float).reshape(-1, 3)))
    branches = [b["nodes"] for b in truth.data["branches"]]
    require([line for line in found if len(line) > 1] == branches, "polylines: the branches")
    require(as_edges(e for line in found for e in zip(line, line[1:])) == truth.edges, "polylines: the edges")
    require(sum(len(line) == 1 for line in found) == truth.lone, "polylines: the lone nodes")


def check_ply(truth):
    """The values that Open3D leaves out, too."""
    with open(truth.written(".ply")) as file:
        head, body = file.read().split("end_header\n")
    properties = [line.split()[-1] for line in head.splitlines() if line.startswith("property")]
    require(properties == ["x", "y", "z", "radius", "volume", "solid", "vertex1", "vertex2"], "PLY: the properties")
    lines = body.splitlines()
    count = len(truth.points)
    require(f"element vertex {count}\n" in head and f"element edge {len(truth.edges)}\n" in head, "PLY: the counts")
    rows = np.loadtxt(lines[:count], ndmin=2)
    expected = np.column_stack([truth.points, truth.radii, truth.volumes, truth.solids])
    require(np.array_equal(rows, expected), "PLY: the values")
    require(as_edges(line.split() for line in lines[count:]) == truth.edges, "PLY: the edges")


def gltf_parts(path):
    """The JSON and the buffer, by the specification of glTF 2.0."""
    with open(path, "rb") as file:
        raw = file.read()
    if path.endswith(".gltf"):
        document = json.loads(raw)
        head, data = document["buffers"][0]["uri"].split(",")
        require(head == "data:application/octet-stream;base64", "gltf: the data's type")
        return document, base64.b64decode(data, validate=True)
    magic, version, size, json_size, json_type = struct.unpack_from("<4sIII4s", raw)
    require((magic, version, size, json_type) == (b"glTF", 2, len(raw), b"JSON"), "glb: the header")
    require(json_size % 4 == 0, "glb: the JSON's size")
    bin_size, bin_type = struct.unpack_from("<I4s", raw, 20 + json_size)
    require(bin_type == b"BIN\0" and bin_size % 4 == 0 and 28 + json_size + bin_size == size, "glb: the bytes")
    return json.loads(raw[20:20 + json_size]), raw[28 + json_size:]


def check_gltf(truth):
    for extension in (".gltf", ".glb"):
        document, buffer = gltf_parts(truth.written(extension))
        require(document["asset"]["version"] == "2.0", "gltf: the version")
        require(document["buffers"][0]["byteLength"] == len(buffer), "gltf: the buffer's size")
        primitive = document["meshes"][0]["primitives"][0]
        require(primitive["mode"] == 1, "gltf: no lines")

        def values(number, component, numpy_type, width):
            accessor = document["accessors"][number]
            view = document["bufferViews"][accessor["bufferView"]]
            require(accessor["componentType"] == component and view["byteOffset"] % 4 == 0, "gltf: an accessor")
            require(view["byteLength"] == 4 * width * accessor["count"], "gltf: a view's size")
            return np.frombuffer(buffer, numpy_type, width * accessor["count"], view["byteOffset"]), accessor

        places, accessor = values(primitive["attributes"]["POSITION"], 5126, "<f4", 3)
        places = places.reshape(-1, 3)
        require(np.array_equal(places, truth.points.astype("f4")), "gltf: the places")
        for key, least in (("min", places.min(0)), ("max", places.max(0))):
            require(np.array_equal(np.array(accessor[key], "f4"), least), f"gltf: {key}")
        radii, _ = values(primitive["attributes"]["_RADIUS"], 5126, "<f4", 1)
        require(np.array_equal(radii, truth.radii.astype("f4")), "gltf: the radii")
        ends, _ = values(primitive["indices"], 5125, "<u4", 1)
        require(as_edges(ends.reshape(-1, 2)) == truth.edges, "gltf: the edges")


run_checks(check_networkx, check_swc, check_polylines, check_ply, check_gltf)
