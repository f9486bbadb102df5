"""The fields of Foxglove's published schemas (foxglove-schemas-protobuf 0.4.0), as far as a scene has them: what another program
reads. [x] is a list of x."""

TIME = {"sec": int, "nsec": int}
VECTOR = {"x": float, "y": float, "z": float}
QUATERNION = VECTOR | {"w": float}
POSE = {"position": VECTOR, "orientation": QUATERNION}
COLOUR = {"r": float, "g": float, "b": float, "a": float}
SHAPE = {"pose": POSE, "color": COLOUR}
ENTITY = {
    "timestamp": TIME, "frame_id": str, "id": str, "lifetime": TIME, "frame_locked": bool,
    "metadata": [{"key": str, "value": str}],
    "arrows": [SHAPE | {"shaft_length": float, "shaft_diameter": float, "head_length": float, "head_diameter": float}],
    "cubes": [SHAPE | {"size": VECTOR}],
    "spheres": [SHAPE | {"size": VECTOR}],
    "cylinders": [SHAPE | {"size": VECTOR, "bottom_scale": float, "top_scale": float}],
    "lines": [SHAPE | {"type": int, "thickness": float, "scale_invariant": bool, "points": [VECTOR], "colors": [COLOUR], "indices": [int]}],
    "triangles": [SHAPE | {"points": [VECTOR], "colors": [COLOUR], "indices": [int]}],
    "texts": [SHAPE | {"billboard": bool, "font_size": float, "scale_invariant": bool, "text": str}],
    "models": [SHAPE | {"scale": VECTOR, "override_color": bool, "url": str, "media_type": str, "data": str}],
}  # fmt: skip
FIELDS = {
    "foxglove.SceneUpdate": {"deletions": [{"timestamp": TIME, "type": int, "id": str}], "entities": [ENTITY]},
    "foxglove.FrameTransforms": {"transforms": [{"timestamp": TIME, "parent_frame_id": str, "child_frame_id": str,
                                                 "translation": VECTOR, "rotation": QUATERNION}]},
    "foxglove.Log": {"timestamp": TIME, "level": int, "message": str, "name": str, "file": str, "line": int},
}  # fmt: skip
KINDS = {float: "number", int: "integer", str: "string", bool: "boolean"}


def differences(value, fields, place=""):
    """Where a message is not what its schema says."""
    if isinstance(fields, dict):
        if value.keys() != fields.keys():
            return [f"{place}: {sorted(value.keys() ^ fields.keys())}"]
        return [found for key, part in fields.items() for found in differences(value[key], part, f"{place}.{key}")]
    if isinstance(fields, list):
        return [found for part in value for found in differences(part, fields[0], f"{place}[]")]
    wanted = (int, float) if fields is float else fields
    is_it = isinstance(value, wanted) and (fields is bool or not isinstance(value, bool))
    return [] if is_it else [f"{place}: {value!r}"]


def schema_of(fields):
    """The same as a JSON Schema, without titles and bounds."""
    if isinstance(fields, dict):
        return {"type": "object", "properties": {key: schema_of(part) for key, part in fields.items()}}
    if isinstance(fields, list):
        return {"type": "array", "items": schema_of(fields[0])}
    return {"type": KINDS[fields]}


def bare(schema):
    """A JSON Schema with its types alone."""
    kept = {"type": schema["type"]}
    if "properties" in schema:
        kept["properties"] = {key: bare(part) for key, part in schema["properties"].items()}
    if "items" in schema:
        kept["items"] = bare(schema["items"])
    return kept
