"""The scene of a log as an MCAP file that Foxglove, Lichtblick and others open: frames, robot, ground, forces."""

import json

import numpy as np
from mcap.writer import CompressionType, Writer

from surefoot_campaign.errors import InputError
from surefoot_campaign.output_files import written_whole
from surefoot_log import foxglove_schemas as schemas
from surefoot_log import foxglove_shapes as shapes
from surefoot_log import meshes
from surefoot_log.foxglove_events import Events
from surefoot_log.foxglove_ground import ground_entity
from surefoot_log.frames import LOADED, FrameMaker
from surefoot_log.offscreen import mujoco
from surefoot_log.log_file import SUMMARY
from surefoot_log.overlays import COM, METRES_PER_NEWTON, POLYGON, PUSH, colour_of_use, hull, push_arrow
from surefoot_log.table import check_topics
from surefoot_log.urdf_visuals import file_of, visuals_on_bodies

WORLD, CONTROLLERS_WORLD = "S", "W"
DETAIL = 0.008  # m
SCENE_EVERY = 10  # ticks
PLAIN = (0.6, 0.62, 0.65, 1.0)


class SceneFile:
    """Writes messages of well-known schemas, as JSON."""

    def __init__(self, path):
        self._file = open(path, "wb")
        self._writer = Writer(self._file, compression=CompressionType.ZSTD)
        self._writer.start(profile="", library="surefoot")
        self._channels, self._count = {}, 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._writer.finish()
        self._file.close()

    def channel(self, topic, name, schema):
        if topic not in self._channels:
            data = schema if isinstance(schema, bytes) else json.dumps(schema).encode()
            schema_id = self._writer.register_schema(name, "jsonschema", data)
            self._channels[topic] = self._writer.register_channel(topic, "json", schema_id)
        return self._channels[topic]

    def write(self, topic, name, schema, time, message):
        """`message` as a dictionary, or as JSON already."""
        data = message if isinstance(message, bytes) else json.dumps(message, separators=(",", ":")).encode()
        self._count += 1
        self._writer.add_message(self.channel(topic, name, schema), time, data, time, self._count)

    def update_scene(self, topic, time, entities):
        self.write(topic, "foxglove.SceneUpdate", schemas.SCENE_UPDATE, time, {"deletions": [], "entities": entities})

    def add_attachment(self, name, media_type, data):
        self._writer.add_attachment(0, 0, name, media_type, data)


def nanoseconds(time):
    return round(1e9 * time)


def transforms(model, data, time):
    """The pose of each body in its parent's frame, after mj_kinematics."""
    result = []
    for body in range(1, model.nbody):
        parent = model.body_parentid[body]
        R_WP = data.xmat[parent].reshape(3, 3)
        quaternion = shapes.wxyz_of(R_WP.T @ data.xmat[body].reshape(3, 3))
        result.append({"timestamp": shapes.moment(time), "parent_frame_id": model.body(parent).name if parent else WORLD,
                       "child_frame_id": model.body(body).name, "translation": shapes.vector(R_WP.T @ (data.xpos[body] - data.xpos[parent])),
                       "rotation": shapes.quaternion(quaternion)})  # fmt: skip
    return result


def worlds(frame, time):
    """Where the controller's world lies in the simulator's, in which the scene is."""
    if frame.R_WS is None:
        return []
    R_SW = frame.R_WS.T
    return [{"timestamp": shapes.moment(time), "parent_frame_id": WORLD, "child_frame_id": CONTROLLERS_WORLD,
             "translation": shapes.vector(-R_SW @ frame.p_WS), "rotation": shapes.quaternion(shapes.wxyz_of(R_SW))}]  # fmt: skip


def mesh_triangles(visual, X_BV, packages, cache):
    found = []
    for part in meshes.load(file_of(visual.mesh, packages), cache, DETAIL, packages):
        points = np.round(part.vertices * visual.scale @ X_BV[:3, :3].T + X_BV[:3, 3], 4)
        found.append(shapes.triangles(points, part.faces.ravel(), part.colour))
    return found


def shape_of(visual, X_BV):
    rgba = visual.colour or PLAIN
    if visual.shape == "box":
        return {"cubes": [shapes.cube(X_BV, visual.size, rgba)]}
    if visual.shape == "sphere":
        return {"spheres": [shapes.sphere(X_BV[:3, 3], visual.size[0], rgba)]}
    return {"cylinders": [shapes.cylinder(X_BV, visual.size[0], visual.size[1], rgba)]}


def physics_shapes(model, body):
    """Shapes of the physics, for a body whose mesh is missing."""
    found = {}
    for geom in np.flatnonzero(model.geom_bodyid == body):
        X_BG = shapes.transform(model.geom_pos[geom], model.geom_quat[geom])
        size, kind = model.geom_size[geom], model.geom_type[geom]
        if kind == mujoco.mjtGeom.mjGEOM_BOX:
            found.setdefault("cubes", []).append(shapes.cube(X_BG, 2 * size, PLAIN))
        elif kind == mujoco.mjtGeom.mjGEOM_SPHERE:
            found.setdefault("spheres", []).append(shapes.sphere(X_BG[:3, 3], size[0], PLAIN))
        elif kind in (mujoco.mjtGeom.mjGEOM_CYLINDER, mujoco.mjtGeom.mjGEOM_CAPSULE):
            found.setdefault("cylinders", []).append(shapes.cylinder(X_BG, size[0], 2 * size[1], PLAIN))
    return found


def robot_entities(model, urdf, packages, cache):
    """One entity for each body, fixed to its frame; and notes on missing meshes."""
    names = {model.body(body).name: body for body in range(1, model.nbody)}
    parts, missing = {}, []
    for visual, body, X_BV in visuals_on_bodies(urdf, names):
        try:
            shown = {"triangles": mesh_triangles(visual, X_BV, packages, cache)} if visual.mesh else shape_of(visual, X_BV)
        except (OSError, ValueError) as error:
            missing.append((visual.link, visual.mesh, error))
            shown = physics_shapes(model, names[body])
        for kind, primitives in shown.items():
            parts.setdefault(body, {}).setdefault(kind, []).extend(primitives)
    parts = parts or {name: physics_shapes(model, body) for name, body in names.items()}
    entities = [shapes.entity(f"robot {name}", name, 0, locked=True, **primitives) for name, primitives in parts.items()]
    return entities, meshes.missing_notes(missing, packages)


def scene_entities(frame, foot_radius, places):
    """What a frame shows over the robot. `places`: the centres of mass of the physics' bodies."""
    time = nanoseconds(frame.time)
    arrows = [shapes.arrow(touch.point, touch.force, METRES_PER_NEWTON, colour_of_use(touch.friction_use))
              for touch in frame.forces if np.linalg.norm(touch.force) > LOADED / 4]  # fmt: skip
    pushes = [shapes.arrow(*push_arrow(places[body], force, torque), 1.0, PUSH) for body, force, torque in frame.pushes]
    entities = [shapes.entity("forces", WORLD, time, arrows=arrows), shapes.entity("pushes", WORLD, time, arrows=pushes)]
    feet = frame.carrying_feet
    level = max((foot[2] for foot in feet), default=0.0) - foot_radius + 0.003
    corners = hull([(*foot[:2], level) for foot in feet]) if len(feet) > 2 else []
    lines = [shapes.loop(corners, 0.008, (*POLYGON, 1.0))] if corners else []
    entities.append(shapes.entity("support polygon", WORLD, time, lines=lines))
    if frame.p_SCom is not None:
        below = [*frame.p_SCom[:2], level]
        entities.append(shapes.entity("centre of mass", WORLD, time, spheres=[shapes.sphere(frame.p_SCom, 0.022, COM), shapes.sphere(below, 0.015, COM)]))
    return entities


def write_scene(log, path, packages, cache=None, topics=None, every=1):
    """Copies the log's topics, all or some, one of `every` messages of each, and adds the scene, all in the order of time. Returns notes."""
    check_topics(topics, log.topics())
    model = mujoco.MjModel.from_xml_string(log.text("model.xml"))
    robot, notes = robot_entities(model, log.text("robot.urdf"), packages, cache)
    maker = FrameMaker(log, max(every, SCENE_EVERY))
    with written_whole(path) as partial, SceneFile(partial) as file:
        scene, copies, events = Scene(file, log, model, robot), Copies(file, log, topics, every), Events(file, log, log.attachments.get(SUMMARY))
        for time, messages in log.by_time():
            copies.write(messages)
            events.write_until(time)
            frame = maker.frame(messages)
            if frame is not None:
                scene.write(frame)
        if not scene.has_begun:
            raise log.no_tick("show")
        events.write_until()
        for name, data in log.attachments.items():
            file.add_attachment(name, "application/json" if name.endswith(".json") else "text/plain", data)
    if not maker.has_truth:
        notes.append("the log has no /truth: the robot is shown where the controller believed it")
    return notes


class Scene:
    """Writes what each frame shows, and before the first what never changes."""

    def __init__(self, file, log, model, robot):
        self._file, self._log, self._model, self._robot = file, log, model, robot
        self._data = mujoco.MjData(model)
        self._foot_radius = log.header["robot"]["foot_radius"] or 0.03
        self.has_begun = False

    def _begin(self, frame, time):
        if len(frame.qpos) > self._model.nq:
            raise InputError(f"{self._log.path}: its model.xml is not that of its /truth")
        self._file.update_scene("/scene/robot", time, self._robot)
        self._file.update_scene("/scene/ground", time, [ground_entity(self._log.header.get("terrain") or [], WORLD)])
        self.has_begun = True

    def write(self, frame):
        time = nanoseconds(frame.time)
        if not self.has_begun:
            self._begin(frame, time)
        self._data.qpos[: len(frame.qpos)] = frame.qpos
        mujoco.mj_kinematics(self._model, self._data)
        self._file.write("/tf", "foxglove.FrameTransforms", schemas.FRAME_TRANSFORMS, time, {"transforms": transforms(self._model, self._data, time) + worlds(frame, time)})
        self._file.update_scene("/scene/forces", time, scene_entities(frame, self._foot_radius, self._data.xipos))


class Copies:
    """Writes the log's own messages, one of `every` of each topic; all of what was changed from outside, which belongs to no tick."""

    def __init__(self, file, log, topics, every):
        self._file, self._log, self._topics, self._every, self._counts = file, log, topics, every, {}

    def write(self, messages):
        for topic, time, data in messages:
            if self._topics is not None and topic not in self._topics:
                continue
            self._counts[topic] = self._counts.get(topic, -1) + 1
            if topic == "/changes" or self._counts[topic] % self._every == 0:
                schema = self._log.schema_record(topic)
                self._file.write(topic, schema.name, schema.data, time, bytes(data))
