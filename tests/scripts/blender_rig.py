"""blender -b --factory-startup --python blender_rig.py -- FILE.glb VERTICES: Blender's own importer finds an armature,
and every vertex of the mesh follows its bones, by weights that sum to 1. Prints SOUND when all is well."""
import sys

import bpy
import numpy

# Debian 12's importer still asks for a name that its numpy has dropped.
numpy.bool = bool

path, vertices = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.ops.import_scene.gltf(filepath=path)
armatures = [o for o in bpy.data.objects if o.type == "ARMATURE"]
skinned = [o for o in bpy.data.objects if o.type == "MESH" and any(m.type == "ARMATURE" for m in o.modifiers)]
assert len(armatures) == 1, f"{len(armatures)} armatures"
assert len(skinned) == 1, f"{len(skinned)} meshes with an armature"
mesh, bones = skinned[0], armatures[0].data.bones
assert len(mesh.data.vertices) == int(vertices), f"{len(mesh.data.vertices)} vertices, not {vertices}"
names = {g.index: g.name for g in mesh.vertex_groups}
for vertex in mesh.data.vertices:
    assert vertex.groups, f"vertex {vertex.index} has no weights"
    assert all(names[g.group] in bones for g in vertex.groups), f"vertex {vertex.index} follows what is no bone"
    total = sum(g.weight for g in vertex.groups)
    assert abs(total - 1) < 1e-4, f"vertex {vertex.index}: its weights sum to {total}"
# The pose moves the mesh: the last limb's first bone turned.
before = [v.co.copy() for v in mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]
bone = next(b for b in reversed(armatures[0].pose.bones) if b.name.startswith("branch") and not b.name.endswith("_end"))
bone.rotation_mode = "XYZ"
bone.rotation_euler = (0.7, 0, 0)
bpy.context.view_layer.update()
after = [v.co for v in mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]
moved = sum((a - b).length > 1e-4 for a, b in zip(before, after))
assert 0 < moved < len(before), f"{moved} of {len(before)} vertices moved with {bone.name}"
print(f"{len(bones)} bones, {len(before)} vertices, {moved} moved with {bone.name}")
print("SOUND")
