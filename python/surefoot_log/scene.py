"""The MuJoCo model of a log, dressed for pictures: the robot's meshes, light, shadows, sky and ground."""

from dataclasses import dataclass, field
from functools import partial

import numpy as np
from PIL import Image

from surefoot_log import meshes
from surefoot_log.offscreen import mujoco
from surefoot_log.urdf_visuals import file_of, visuals_on_bodies

GROUND = (0.93, 0.93, 0.91, 1.0)
EDGES = (0.74, 0.74, 0.72)
SKY_TOP, SKY_LOW = (0.80, 0.87, 0.95), (0.98, 0.985, 0.99)
ROBOT_GROUP, HIDDEN_GROUP = 2, 4
LARGEST_IMAGE = 512  # pixels of a texture's edge
PLAIN = (0.45, 0.47, 0.5, 1.0)  # colour of the physics' own shapes


@dataclass
class Scene:
    model: mujoco.MjModel
    notes: list = field(default_factory=list)  # what is not shown as it should be


def dress(model_xml, urdf, packages, cache=None, size=(1280, 720), detail=meshes.CELL):
    """Makes the model for pictures of at most a size. What has no mesh here is drawn as the physics has it, with a note."""
    spec = mujoco.MjSpec.from_string(model_xml)
    set_light(spec, size)
    set_ground(spec)
    load = partial(meshes.load, cache=cache, cell=detail, roots=packages)
    notes = add_robot(spec, urdf, packages, load)
    return Scene(spec.compile(), notes)


def set_light(spec, size):
    spec.visual.global_.offwidth, spec.visual.global_.offheight = size
    spec.stat.extent = 1.0  # m: the shadows' part of the world, however large the ground is
    spec.visual.quality.shadowsize = 4096
    spec.visual.quality.offsamples = 4
    spec.visual.headlight.ambient = [0.42, 0.42, 0.44]
    spec.visual.headlight.diffuse = [0.22, 0.22, 0.22]
    spec.visual.headlight.specular = [0.1, 0.1, 0.1]
    spec.visual.map.shadowclip = 10.0  # as far as the ground is seen, because there are black dots at the shadows' rim
    spec.visual.map.znear = 0.02
    spec.visual.map.zfar = 60.0
    spec.visual.rgba.haze = [*SKY_LOW, 1.0]
    spec.worldbody.add_light(name="sun", type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, pos=[0, -1.5, 4], dir=[0.25, 0.45, -1],
                             castshadow=True, diffuse=[0.62, 0.61, 0.58], specular=[0.15, 0.15, 0.15], ambient=[0, 0, 0])  # fmt: skip
    spec.add_texture(name="sky", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX, builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
                     rgb1=list(SKY_TOP), rgb2=list(SKY_LOW), width=512, height=3072)  # fmt: skip


def set_ground(spec):
    """A grid of 0.5 m on everything that belongs to the world."""
    spec.add_texture(name="grid", type=mujoco.mjtTexture.mjTEXTURE_2D, builtin=mujoco.mjtBuiltin.mjBUILTIN_FLAT,
                     rgb1=list(GROUND[:3]), rgb2=list(GROUND[:3]), markrgb=list(EDGES),
                     mark=mujoco.mjtMark.mjMARK_EDGE, width=512, height=512)  # fmt: skip
    material = spec.add_material(name="ground", texrepeat=[2, 2], texuniform=True, specular=0.1, shininess=0.1, reflectance=0.0)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "grid"
    for geom in spec.worldbody.geoms:
        geom.material = "ground"
        geom.rgba = [1, 1, 1, 1]


def add_robot(spec, urdf, packages, load):
    bodies = {body.name: body for body in spec.bodies if body.name}
    missing, dressed, kept = [], set(), {}
    for visual, name, X_BV in visuals_on_bodies(urdf, bodies):
        try:
            add_visual(spec, bodies[name], X_BV, visual, packages, load, kept)
            dressed.add(name)
        except (OSError, ValueError) as error:
            missing.append((visual.link, visual.mesh, error))
    hide_physics(bodies, dressed)
    return meshes.missing_notes(missing, packages)


def hide_physics(bodies, dressed):
    """Hides the shapes of the physics where meshes are shown. A payload, which has no link, stays."""
    for name, body in bodies.items():
        if name == "world":
            continue
        for geom in body.geoms:
            if geom.group == ROBOT_GROUP:
                continue
            if dressed and (name in dressed or below(body, dressed)) and geom.group == 1:
                geom.group = HIDDEN_GROUP
            else:
                geom.rgba = PLAIN


def below(body, dressed):
    """Links without visuals, such as a foot's point, belong to what is above them."""
    return body.parent is not None and body.parent.name in dressed and not list(body.joints)


def add_visual(spec, body, X_BV, visual, packages, load, kept):
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, X_BV[:3, :3].ravel())
    at = {"pos": X_BV[:3, 3], "quat": quaternion, "contype": 0, "conaffinity": 0, "group": ROBOT_GROUP, "mass": 0.0}
    if visual.shape:
        kinds = {"box": mujoco.mjtGeom.mjGEOM_BOX, "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER, "sphere": mujoco.mjtGeom.mjGEOM_SPHERE}
        half = {"box": [edge / 2 for edge in visual.size], "cylinder": [visual.size[0], visual.size[-1] / 2, 0],
                "sphere": [visual.size[0], 0, 0]}  # fmt: skip
        body.add_geom(type=kinds[visual.shape], size=half[visual.shape], rgba=visual.colour or PLAIN, **at)
        return
    for name in mesh_parts(spec, visual, packages, load, kept):
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, material=name, **at)


def mesh_parts(spec, visual, packages, load, kept):
    """The names of its meshes, which are those of their materials, too."""
    key = (visual.mesh, visual.scale)
    if key not in kept:
        parts = load(file_of(visual.mesh, packages))
        kept[key] = [add_part(spec, part, f"mesh{len(kept)}_{i}", visual.scale) for i, part in enumerate(parts)]
    return kept[key]


def add_part(spec, part, name, scale):
    mesh = spec.add_mesh(name=name, uservert=part.vertices.astype(np.float32).ravel(), userface=part.faces.astype(np.int32).ravel(),
                         scale=scale, inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL)  # fmt: skip
    material = spec.add_material(name=name, rgba=lifted(part.colour), specular=0.35, shininess=0.45)
    if part.uv is not None:
        uv = part.uv * [1.0, -1.0] + [0.0, 1.0]
        mesh.usertexcoord = uv.astype(np.float32).ravel()
        mesh.userfacetexcoord = part.faces.astype(np.int32).ravel()
        add_texture(spec, part.image, name)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
        material.rgba = [1, 1, 1, 1]
    return name


def lifted(colour):
    """Black parts keep some of the light, so that their form is seen."""
    return [0.06 + 0.94 * part for part in colour[:3]] + [colour[3]]


def add_texture(spec, path, name):
    with Image.open(path) as image:
        image = image.convert("RGB")
        image.thumbnail((LARGEST_IMAGE, LARGEST_IMAGE))
        texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D, width=image.width, height=image.height, nchannel=3)
        texture.data = image.tobytes()
