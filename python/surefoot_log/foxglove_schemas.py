"""Foxglove's well-known schemas as JSON Schemas, as far as a scene needs them: https://docs.foxglove.dev/docs/sdk/schemas."""

TIME = {"type": "object", "title": "time", "properties": {"sec": {"type": "integer", "minimum": 0}, "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}}}
DURATION = {"type": "object", "title": "duration", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}}}
NUMBER, TEXT, TRUTH, BYTES = {"type": "number"}, {"type": "string"}, {"type": "boolean"}, {"type": "string", "contentEncoding": "base64"}


def record(title, **properties):
    return {"type": "object", "title": title, "properties": properties}


def list_of(items):
    return {"type": "array", "items": items}


VECTOR = record("foxglove.Vector3", x=NUMBER, y=NUMBER, z=NUMBER)
POINT = record("foxglove.Point3", x=NUMBER, y=NUMBER, z=NUMBER)
QUATERNION = record("foxglove.Quaternion", x=NUMBER, y=NUMBER, z=NUMBER, w=NUMBER)
COLOUR = record("foxglove.Color", r=NUMBER, g=NUMBER, b=NUMBER, a=NUMBER)
POSE = record("foxglove.Pose", position=VECTOR, orientation=QUATERNION)

FRAME_TRANSFORM = record("foxglove.FrameTransform", timestamp=TIME, parent_frame_id=TEXT, child_frame_id=TEXT, translation=VECTOR,
                         rotation=QUATERNION)  # fmt: skip
FRAME_TRANSFORMS = record("foxglove.FrameTransforms", transforms=list_of(FRAME_TRANSFORM))

ARROW = record("foxglove.ArrowPrimitive", pose=POSE, shaft_length=NUMBER, shaft_diameter=NUMBER, head_length=NUMBER,
               head_diameter=NUMBER, color=COLOUR)  # fmt: skip
CUBE = record("foxglove.CubePrimitive", pose=POSE, size=VECTOR, color=COLOUR)
SPHERE = record("foxglove.SpherePrimitive", pose=POSE, size=VECTOR, color=COLOUR)
CYLINDER = record("foxglove.CylinderPrimitive", pose=POSE, size=VECTOR, bottom_scale=NUMBER, top_scale=NUMBER, color=COLOUR)
LINE = record("foxglove.LinePrimitive", type={"type": "integer"}, pose=POSE, thickness=NUMBER, scale_invariant=TRUTH,
              points=list_of(POINT), color=COLOUR, colors=list_of(COLOUR), indices=list_of({"type": "integer"}))  # fmt: skip
TRIANGLES = record("foxglove.TriangleListPrimitive", pose=POSE, points=list_of(POINT), color=COLOUR, colors=list_of(COLOUR),
                   indices=list_of({"type": "integer"}))  # fmt: skip
LABEL = record("foxglove.TextPrimitive", pose=POSE, billboard=TRUTH, font_size=NUMBER, scale_invariant=TRUTH, color=COLOUR, text=TEXT)
MODEL = record("foxglove.ModelPrimitive", pose=POSE, scale=VECTOR, color=COLOUR, override_color=TRUTH, url=TEXT, media_type=TEXT, data=BYTES)
ENTITY = record("foxglove.SceneEntity", timestamp=TIME, frame_id=TEXT, id=TEXT, lifetime=DURATION, frame_locked=TRUTH,
                metadata=list_of(record("foxglove.KeyValuePair", key=TEXT, value=TEXT)), arrows=list_of(ARROW), cubes=list_of(CUBE),
                spheres=list_of(SPHERE), cylinders=list_of(CYLINDER), lines=list_of(LINE), triangles=list_of(TRIANGLES),
                texts=list_of(LABEL), models=list_of(MODEL))  # fmt: skip
DELETION = record("foxglove.SceneEntityDeletion", timestamp=TIME, type={"type": "integer"}, id=TEXT)
SCENE_UPDATE = record("foxglove.SceneUpdate", deletions=list_of(DELETION), entities=list_of(ENTITY))
LOG = record("foxglove.Log", timestamp=TIME, level={"type": "integer"}, message=TEXT, name=TEXT, file=TEXT, line={"type": "integer"})
