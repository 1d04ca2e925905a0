"""Reads skeletons with VTK and Open3D, some hundred megabytes, and compares all values with the JSON.

Usage: formats_vtk_test.py PROGRAM MODELS_DIR   (exit code 77: a reader is not installed)
"""

from skeleton_truth import as_edges, leave_out, require, run_checks

try:
    import numpy as np
    import open3d
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    leave_out(missing)

FLOAT = 1e-6  # of the model's size, where a format or a reader keeps 32 bits


def close(truth, found, expected):
    return np.shape(found) == np.shape(expected) and np.abs(found - expected).max() <= FLOAT * truth.size


def vtk_output(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def vtk_lines(data):
    """The points of each line."""
    cells = data.GetLines()
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    points = vtk_to_numpy(cells.GetConnectivityArray())
    return [list(map(int, points[a:b])) for a, b in zip(ends, ends[1:])]


def vtk_points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def check_vtp(truth):
    data = vtk_output(vtk.vtkXMLPolyDataReader(), truth.written(".vtp"))
    require(np.array_equal(vtk_points(data), truth.points), "VTP: the places")
    branches = truth.data["branches"]
    require(vtk_lines(data) == [b["nodes"] for b in branches], "VTP: the branches")
    require(data.GetNumberOfVerts() == truth.lone, "VTP: the lone nodes")
    point_data = data.GetPointData()
    for name, values in (("MaximumInscribedSphereRadius", truth.radii), ("NodeVolume", truth.volumes),
                         ("Solid", truth.solids)):
        require(np.array_equal(vtk_to_numpy(point_data.GetArray(name)), values), f"VTP: {name}")
    require(point_data.GetScalars().GetName() == "MaximumInscribedSphereRadius", "VTP: the scalars")
    cell_data = data.GetCellData()
    for name, values in (("BranchLength", [b["length"] for b in branches]), ("BranchId", list(range(len(branches)))),
                         ("BranchMeanRadius", [b["mean_radius"] for b in branches])):
        found = vtk_to_numpy(cell_data.GetArray(name))
        require(len(found) == data.GetNumberOfCells(), f"VTP: the number of {name}")
        require(found[truth.lone:].tolist() == values, f"VTP: {name}")
    origin = data.GetFieldData().GetAbstractArray("Origin").GetValue(0)
    require(origin.startswith("zskel ") and "convert" in origin, f"VTP: the origin, {origin}")


def gltf_pieces(path):
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(path)
    reader.Update()
    walk = reader.GetOutput().NewIterator()
    walk.InitTraversal()
    while not walk.IsDoneWithTraversal():
        yield walk.GetCurrentDataObject()
        walk.GoToNextItem()


def check_vtk_lines(truth):
    check_vtp(truth)
    data = vtk_output(vtk.vtkOBJReader(), truth.written(".obj"))
    require(close(truth, vtk_points(data), truth.points), "OBJ: the places")
    require(as_edges(vtk_lines(data)) == truth.edges, "OBJ: the edges")
    for extension in (".gltf", ".glb"):
        pieces = list(gltf_pieces(truth.written(extension)))
        require(len(pieces) == 1, f"{extension}: one piece")
        require(close(truth, vtk_points(pieces[0]), truth.points), f"{extension}: the places")
        require(as_edges(vtk_lines(pieces[0])) == truth.edges, f"{extension}: the edges")
        radii = vtk_to_numpy(pieces[0].GetPointData().GetArray("_RADIUS"))
        require(close(truth, radii, truth.radii), f"{extension}: the radii")


def check_open3d(truth):
    lines = open3d.io.read_line_set(truth.written(".ply"))
    require(np.array_equal(np.asarray(lines.points), truth.points), "PLY: the places")
    require(as_edges(np.asarray(lines.lines)) == truth.edges, "PLY: the edges")


def check_tube_surface(truth, data, what):
    """Closed, outward, a piece for each branch and lone node, every vertex at a node's radius."""
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(data)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    require(edges.GetOutput().GetNumberOfCells() == 0, f"{what}: not closed")
    pieces = vtk.vtkPolyDataConnectivityFilter()
    pieces.SetInputData(data)
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    require(pieces.GetNumberOfExtractedRegions() == len(truth.data["branches"]) + truth.lone, f"{what}: the pieces")
    points = vtk_points(data).astype(float)
    corners = points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    require(volume > 0, f"{what}: inside out")
    distances = np.linalg.norm(points[:, None] - truth.points[None], axis=2)
    require((np.abs(distances - truth.radii).min(axis=1) <= FLOAT * truth.size).all(), f"{what}: the thickness")


def check_tubes(truth):
    for extension, reader in ((".ply", vtk.vtkPLYReader), (".obj", vtk.vtkOBJReader)):
        check_tube_surface(truth, vtk_output(reader(), truth.written(extension, "--tubes")), extension)
    for extension in (".gltf", ".glb"):
        (piece,) = gltf_pieces(truth.written(extension, "--tubes"))
        check_tube_surface(truth, piece, extension)
    mesh = open3d.io.read_triangle_mesh(truth.written(".ply", "--tubes"))
    require(mesh.is_edge_manifold(allow_boundary_edges=False) and mesh.is_orientable(), "tubes: no closed surface")


run_checks(check_vtk_lines, check_open3d, check_tubes)
