"""What a URDF says about how its links look."""

import math
import os
import pathlib
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np

NUMBERS_OF = {"box": ("size",), "cylinder": ("radius", "length"), "sphere": ("radius",)}


@dataclass(frozen=True)
class Visual:
    """A mesh file or a shape, fixed to a link."""

    link: str
    X_LV: np.ndarray  # 4 × 4, takes the visual's coordinates to the link's
    mesh: str = ""  # its URI, as in the file
    scale: tuple = (1.0, 1.0, 1.0)
    shape: str = ""  # box, cylinder or sphere
    size: tuple = ()  # m: edges of a box; radius and length of a cylinder; radius of a sphere
    colour: tuple | None = None


def rotation(rpy):
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])  # fmt: skip


def numbers(text, count):
    values = [float(word) for word in (text or "").split()]
    if len(values) != count or not all(map(math.isfinite, values)):
        raise ValueError(f'expected {count} numbers, got "{text}"')
    return values


def pose(element):
    """The pose in the <origin> of an element."""
    result = np.eye(4)
    origin = element.find("origin")
    if origin is not None:
        result[:3, :3] = rotation(numbers(origin.get("rpy", "0 0 0"), 3))
        result[:3, 3] = numbers(origin.get("xyz", "0 0 0"), 3)
    return result


def colours_of(robot):
    found = {}
    for material in robot.iter("material"):
        colour = material.find("color")
        if colour is not None and material.get("name"):
            found.setdefault(material.get("name"), tuple(numbers(colour.get("rgba"), 4)))
    return found


def visuals_of(urdf):
    """All visuals of a URDF (text), link by link."""
    robot = ElementTree.fromstring(urdf)
    colours = colours_of(robot)
    return [visual for link in robot.iter("link") for element in link.findall("visual")
            if (visual := visual_of(element, link.get("name"), colours)) is not None]  # fmt: skip


def visual_of(element, link, colours):
    shapes = list(element.find("geometry") if element.find("geometry") is not None else [])
    if not shapes:
        return None
    (shape, *_), material = shapes, element.find("material")
    colour = colours.get(material.get("name")) if material is not None else None
    if shape.tag == "mesh":
        scale = tuple(numbers(shape.get("scale", "1 1 1"), 3))
        return Visual(link, pose(element), mesh=shape.get("filename", ""), scale=scale, colour=colour)
    if shape.tag not in NUMBERS_OF:
        return None
    size = sum((numbers(shape.get(name), 3 if name == "size" else 1) for name in NUMBERS_OF[shape.tag]), [])
    return Visual(link, pose(element), shape=shape.tag, size=tuple(size), colour=colour)


def links_below_bodies(urdf, bodies):
    """For each link the body that carries it, and its fixed pose in that body's frame."""
    robot = ElementTree.fromstring(urdf)
    parents = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}
    found = {}
    for link in (element.get("name") for element in robot.findall("link")):
        body, X_BL = link, np.eye(4)
        while body not in bodies and body in parents:
            X_BL = pose(parents[body]) @ X_BL
            body = parents[body].find("parent").get("link")
        if body in bodies:
            found[link] = (body, X_BL)
    return found


def visuals_on_bodies(urdf, bodies):
    """Each visual that one of the bodies carries, with that body's name and its pose there."""
    carriers = links_below_bodies(urdf, bodies)
    for visual in visuals_of(urdf):
        if visual.link in carriers:
            body, X_BL = carriers[visual.link]
            yield visual, body, X_BL @ visual.X_LV


def file_of(uri, packages):
    """Where a mesh lies: `package://NAME/…` in one of the folders of packages, and nowhere else. Throws ValueError."""
    inside = os.path.normpath(uri.removeprefix("package://"))
    if not uri.startswith("package://") or os.path.isabs(inside) or inside.split(os.sep)[0] in ("..", "."):
        raise ValueError("is not below the folder of packages; package://NAME/… would be valid")
    name = inside.split(os.sep)[0]
    places = [place for folder in map(pathlib.Path, packages)
              for place in (folder / inside, *([folder.parent / inside] if folder.name == name else []))]  # fmt: skip
    return next((place for place in places if place.is_file()), places[0])
