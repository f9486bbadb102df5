"""Triangles of a mesh file, few enough to be drawn quickly, by material: Collada, STL and OBJ."""

import hashlib
import io
import os
import pathlib
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib
from dataclasses import dataclass

import numpy as np

CELL = 0.005  # m: points of one material in a cell of this size become one
UNKNOWN = (0.25, 0.26, 0.28, 1.0)  # colour where a file names none
CACHE_FORMAT = "4"
MOST_NOTES = 3  # of meshes that are missing


@dataclass(frozen=True)
class Part:
    """Triangles of one material, in the mesh's own frame [m]."""

    vertices: np.ndarray  # n × 3
    faces: np.ndarray  # m × 3, indices of vertices
    colour: tuple  # red, green, blue, opacity
    uv: np.ndarray | None = None  # n × 2, where the material has an image
    image: str = ""  # file of that image


def merged(vertices, faces, uv, cell):
    """The triangles that are left when all points of a cell become their mean."""
    keys = np.round(vertices / cell).astype(np.int64)
    if uv is not None:
        keys = np.hstack([keys, np.round(uv * 64).astype(np.int64)])
    _, cells, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    cells = cells.ravel()

    def mean(values):
        sums = np.zeros((len(counts), values.shape[1]))
        np.add.at(sums, cells, values)
        return sums / counts[:, None]

    corners = cells[faces]
    distinct = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 0] != corners[:, 2])
    _, first = np.unique(np.sort(corners, axis=1), axis=0, return_index=True)
    kept = np.zeros(len(corners), bool)
    kept[first] = True
    return mean(vertices), corners[kept & distinct], None if uv is None else mean(uv)


def used_only(vertices, faces, uv):
    used, renumbered = np.unique(faces, return_inverse=True)
    return vertices[used], renumbered.reshape(-1, 3), None if uv is None else uv[used]


def image_file(folder, name, roots):
    """The path of an image; empty if it lies below none of the roots."""
    path = pathlib.Path(os.path.normpath(folder / name))
    return str(path) if any(path.is_relative_to(os.path.normpath(root)) for root in roots) else ""


def material_of(primitive, folder, roots):
    """Colour and image of a bound Collada primitive."""
    from collada.material import Map

    effect = getattr(primitive.material, "effect", None)
    diffuse = getattr(effect, "diffuse", None)
    if isinstance(diffuse, Map):
        return UNKNOWN, image_file(folder, diffuse.sampler.surface.image.path, roots)
    return tuple(float(part) for part in diffuse) if diffuse is not None else UNKNOWN, ""


def triangles_of(primitive):
    """Vertices, faces and, where there are, texture coordinates, one vertex a corner."""
    if hasattr(primitive, "triangleset"):
        primitive = primitive.triangleset()
    vertices = np.asarray(primitive.vertex, float)[np.asarray(primitive.vertex_index).ravel()]
    uv = None
    if len(primitive.texcoordset) > 0:
        uv = np.asarray(primitive.texcoordset[0], float)[np.asarray(primitive.texcoord_indexset[0]).ravel(), :2]
    return vertices, np.arange(len(vertices)).reshape(-1, 3), uv


def opened_collada(path):
    """The document, without references to materials that it does not have, as exporters leave them."""
    import collada

    def opened(data):
        return collada.Collada(io.BytesIO(data), ignore=[collada.common.DaeError])

    data = path.read_bytes()
    document = opened(data)
    tree = ElementTree.fromstring(data)
    space = tree.tag.removesuffix("COLLADA")
    broken = [(parent, child) for parent in tree.iter(f"{space}technique_common") for child in parent.findall(f"{space}instance_material")
              if child.get("target", "#").removeprefix("#") not in document.materials]  # fmt: skip
    for parent, child in broken:
        parent.remove(child)
    return opened(ElementTree.tostring(tree)) if broken else document


def read_collada(path, roots):
    """Ignores the file's up axis, as ROS tools do: up is z."""
    document = opened_collada(path)
    by_material = {}
    for geometry in document.scene.objects("geometry"):
        for primitive in geometry.primitives():
            if len(primitive) == 0 or "Line" in type(primitive).__name__:
                continue
            colour, image = material_of(primitive, path.parent, roots)
            vertices, faces, uv = triangles_of(primitive)
            piece = (vertices * document.assetInfo.unitmeter, faces, uv if image else None)
            by_material.setdefault((colour, image if uv is not None else ""), []).append(piece)
    if not by_material:
        raise ValueError("no triangles are in it")
    return [joined(pieces, *material) for material, pieces in by_material.items()]


def joined(pieces, colour, image):
    offsets = np.cumsum([0, *(len(vertices) for vertices, _, _ in pieces)])
    faces = np.vstack([faces + offset for (_, faces, _), offset in zip(pieces, offsets)])
    uv = np.vstack([uv for _, _, uv in pieces]) if image else None
    return Part(np.vstack([vertices for vertices, _, _ in pieces]), faces, colour, uv, image)


def read_stl(path, _):
    data = path.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count:
        raise ValueError("not a binary STL file")
    corners = np.frombuffer(data, np.dtype([("normal", "<f4", 3), ("v", "<f4", (3, 3)), ("rest", "<u2")]), count, 84)["v"]
    return [Part(corners.reshape(-1, 3).astype(float), np.arange(3 * count).reshape(-1, 3), UNKNOWN)]


def read_obj(path, _):
    vertices, faces = [], []
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [corner - 1 if corner > 0 else len(vertices) + corner for corner in corners]
            faces += [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
    return [Part(np.array(vertices, float).reshape(-1, 3), np.array(faces, int).reshape(-1, 3), UNKNOWN)]


READERS = {".dae": read_collada, ".stl": read_stl, ".obj": read_obj}


def load(path, cache=None, cell=CELL, roots=None):
    """The parts of a mesh file, thinned to a cell [m]. `cache`: a folder that keeps them for the next time. `roots`: folders
    that its images must lie below one of; its own by default."""
    path = pathlib.Path(path)
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise ValueError(f"is not one of {', '.join(READERS)}")
    kept = None
    if cache is not None:
        digest = hashlib.sha256(f"{CACHE_FORMAT} {cell} ".encode() + str(path.parent).encode() + path.read_bytes()).hexdigest()[:20]
        kept = pathlib.Path(cache) / f"{path.stem}-{digest}.npz"
        known = unpacked(kept)
        if known is not None:
            return known
    parts = [thinned(part, cell) for part in reader(path, [path.parent] if roots is None else roots)]
    parts = [part for part in parts if len(part.faces) > 0]
    if kept is not None:
        pack(parts, kept)
    return parts


def thinned(part, cell):
    vertices, faces, uv = used_only(*merged(part.vertices, part.faces, part.uv, cell))
    return Part(vertices, faces, part.colour, uv, part.image)


def pack(parts, path):
    arrays = {"count": len(parts)}
    for i, part in enumerate(parts):
        arrays |= {f"v{i}": part.vertices, f"f{i}": part.faces, f"c{i}": np.array(part.colour), f"i{i}": np.array(part.image)}
        if part.uv is not None:
            arrays[f"t{i}"] = part.uv
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=path.stem, suffix=".partial", delete=False) as partial:
        np.savez_compressed(partial, **arrays)
    os.replace(partial.name, path)


def unpacked(path):
    """The parts in a file of the cache; None if it is missing or can't be read."""
    try:
        with np.load(path) as arrays:
            return parts_in(arrays)
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error):
        return None


def parts_in(arrays):
    return [Part(arrays[f"v{i}"], arrays[f"f{i}"], tuple(arrays[f"c{i}"].tolist()), arrays.get(f"t{i}"), str(arrays[f"i{i}"]))
            for i in range(int(arrays["count"]))]  # fmt: skip


def missing_notes(missing, packages):
    """Notes on links without their meshes, `missing` by link, mesh and error: a line each if they are few, else one line."""
    reasons = [f"{mesh}: {error.strerror if isinstance(error, OSError) else error}" for _, mesh, error in missing]
    if len(missing) <= MOST_NOTES:
        return [f"{link} is shown as the physics has it: {reason}" for (link, *_), reason in zip(missing, reasons)]
    return [f"{len(missing)} parts of the robot are shown as the physics has them, the first of {missing[0][0]}: {reasons[0]}; "
            f"meshes are sought in {', '.join(map(str, packages))} ($SUREFOOT_ROBOT_PACKAGES and $ROS_PACKAGE_PATH name others)"]  # fmt: skip
