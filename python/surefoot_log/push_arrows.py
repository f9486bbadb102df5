"""Arrows of what pushes the robot from outside, drawn over an image so that the body hides none of them."""

import numpy as np
from PIL import Image, ImageDraw

from surefoot_log.overlays import PUSH, push_arrow

EDGE = (28, 31, 36)
SHAFT, HEAD, HEAD_LENGTH, RIM = 0.015, 0.04, 0.09, 0.006  # m: half widths of shaft and head, its length, and the edge beyond them
FILL = tuple(round(255 * part) for part in PUSH[:3])
SMOOTH = 3  # pixels that become one along each edge


class Lens:
    """Takes points to an image of `size` pixels, as MuJoCo's camera of a scene does."""

    def __init__(self, cameras, size):
        self._place = np.mean([camera.pos for camera in cameras], axis=0)
        self._forward = np.mean([camera.forward for camera in cameras], axis=0)
        self._up = np.array(cameras[0].up, float)
        self._right = np.cross(self._forward, self._up)
        camera, (width, height) = cameras[0], size
        self._scale = camera.frustum_near * height / (camera.frustum_top - camera.frustum_bottom)
        middle = 0.5 * (camera.frustum_top + camera.frustum_bottom) * self._scale / camera.frustum_near
        self._centre = np.array([width / 2, height / 2 + middle])

    def depth(self, point):
        return self._forward @ (point - self._place)

    def pixel(self, point):
        """Where a point is seen, from the image's upper left corner."""
        way, scale = point - self._place, self._scale / self.depth(point)
        return self._centre + scale * np.array([self._right @ way, -self._up @ way])

    def pixels(self, point):
        """The length of a metre at a point [pixels]."""
        return self._scale / self.depth(point)


def outline(start, tip, start_scale, tip_scale, rim):
    """Corners of an arrow in the image; one that points along the view is its head alone. `…_scale`: pixels of a metre at its ends."""
    way = tip - start
    length = np.linalg.norm(way)
    along = way / length if length > 0 else np.array([0.0, -1.0])
    across = np.array([-along[1], along[0]])
    head = HEAD_LENGTH * tip_scale
    neck = tip - head * along
    if length < head:
        start = neck
    wide, near, far = (HEAD + 1.5 * rim) * tip_scale, (SHAFT + rim) * start_scale, (SHAFT + rim) * tip_scale
    back, front = rim * start_scale * along, 2.5 * rim * tip_scale * along
    behind = neck - rim * tip_scale * along
    sides = [(start - back, near), (behind, far), (behind, wide)]
    left = [point + width * across for point, width in sides]
    right = [point - width * across for point, width in reversed(sides)]
    return [tuple(point) for point in [*left, tip + front, *right]]


def draw_pushes(image, pushes, places, cameras):
    """`pushes`: of a frame; `places`: of the bodies' centres of mass."""
    lens = Lens(cameras, image.size)
    arrows = []
    for body, force, torque in pushes:
        start, vector = push_arrow(places[body], force, torque)
        tip = start + vector
        if min(lens.depth(start), lens.depth(tip)) > 0.1:  # in front of the camera
            arrows.append((lens.pixel(start), lens.pixel(tip), lens.pixels(start), lens.pixels(tip)))
    for rim, colour in ((RIM, EDGE), (0.0, FILL)):
        mask = Image.new("L", (SMOOTH * image.width, SMOOTH * image.height), 0)
        for arrow in arrows:
            ImageDraw.Draw(mask).polygon([(SMOOTH * x, SMOOTH * y) for x, y in outline(*arrow, rim)], fill=255)
        image.paste(colour, mask=mask.resize(image.size, Image.Resampling.BOX))
    return image
