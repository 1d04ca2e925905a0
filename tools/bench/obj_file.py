"""Vertices and triangles of an OBJ file, as arrays."""
import numpy as np


def read_obj(path):
    rows = [line.split() for line in open(path)]
    vertices = np.array([[float(x) for x in r[1:4]] for r in rows if r and r[0] == "v"])
    faces = np.array([[int(x.split("/")[0]) - 1 for x in r[1:4]] for r in rows if r and r[0] == "f"])
    return vertices, faces


def write_obj(path, vertices, faces):
    with open(path, "w") as out:
        out.writelines("v %r %r %r\n" % tuple(map(float, v)) for v in vertices)
        out.writelines("f %d %d %d\n" % tuple(f + 1) for f in faces)
