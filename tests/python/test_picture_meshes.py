"""Meshes of pictures: found where the URDF says and nowhere else, thinned, kept, and replaced where they are missing."""


import numpy as np
import pytest
from pictures_made import PACKAGES, SIZE, cache, dressed, painted, run  # noqa: F401, fixtures

from surefoot_log import meshes, pictures, urdf_visuals  # isort: skip
from surefoot_log.frames import Frame  # isort: skip


def test_a_mesh_that_is_missing_is_noted_and_the_physics_shape_stands_for_it(log, run, tmp_path, cache):
    scene = dressed(log, packages=[tmp_path])
    (note,) = scene.notes
    assert "parts of the robot are shown as the physics has them, the first of base: package://" in note
    assert f"anymal_base.dae: No such file or directory; meshes are sought in {tmp_path} ($SUREFOOT_ROBOT_PACKAGES" in note
    here = run.frames[0]
    gone = Frame(here.time, [here.qpos[0] + 50.0, *here.qpos[1:]], here.p_SB)
    shown, empty = painted(log, run, [here, gone], packages=[tmp_path])
    assert ((empty - shown).sum(axis=2) > 100).sum() > 0.02 * SIZE[0] * SIZE[1]
    assert dressed(log, cache=cache).notes == []


def test_thinned_meshes_keep_their_size_and_colours(cache):
    urdf = (PACKAGES[0] / "example-robot-data/robots/anymal_b_simple_description/robots/anymal.urdf").read_text()
    files = {urdf_visuals.file_of(visual.mesh, PACKAGES) for visual in urdf_visuals.visuals_of(urdf) if visual.mesh}
    assert len(files) >= 6
    for file in files:
        fine, coarse = meshes.load(file, cache, 0.008), meshes.load(file, cache, 0.02)
        assert {part.colour for part in fine} >= {part.colour for part in coarse}
        span = [np.ptp(np.vstack([part.vertices for part in parts]), axis=0) for parts in (fine, coarse)]
        assert span[0] == pytest.approx(span[1], abs=0.02)
        assert sum(len(part.faces) for part in coarse) < sum(len(part.faces) for part in fine)


@pytest.mark.parametrize("uri", ["file:///etc/passwd", "/etc/passwd", "package://../x.dae", "package://a/../../x.dae", "package:///etc/x.dae", "x.dae", "package://."])
def test_meshes_lie_below_the_folder_of_packages(uri, tmp_path):
    with pytest.raises(ValueError, match="folder of packages"):
        urdf_visuals.file_of(uri, [tmp_path])
    assert urdf_visuals.file_of("package://a/b/../c.dae", [tmp_path]) == tmp_path / "a" / "c.dae"


def test_meshes_are_found_in_every_folder_of_packages(tmp_path, monkeypatch):
    for folder in ("one", "two/share"):
        (tmp_path / folder / "robot").mkdir(parents=True)
    (tmp_path / "two/share/robot/leg.stl").write_text("mesh")
    (tmp_path / "one/robot/arm.stl").write_text("mesh")
    for name, value in {"SUREFOOT_ROBOT_PACKAGES": "", "ROS_PACKAGE_PATH": f"{tmp_path}/one/robot:", "AMENT_PREFIX_PATH": f"{tmp_path}/two"}.items():
        monkeypatch.setenv(name, value)
    folders = pictures.package_folders()
    assert urdf_visuals.file_of("package://robot/leg.stl", folders) == tmp_path / "two/share/robot/leg.stl"
    assert urdf_visuals.file_of("package://robot/arm.stl", folders) == tmp_path / "one/robot/arm.stl", "a folder that is the package"


def test_images_lie_there_too(tmp_path):
    assert meshes.image_file(tmp_path / "a" / "meshes", "../images/x.png", [tmp_path]) == str(tmp_path / "a" / "images" / "x.png")
    assert meshes.image_file(tmp_path / "a", "../../x.png", [tmp_path]) == ""
    assert meshes.image_file(tmp_path / "a", "/etc/x.png", [tmp_path]) == ""


def test_of_a_few_meshes_that_are_missing_each_is_noted():
    missing = [("a", "package://a.dae", FileNotFoundError(2, "No such file")), ("b", "b.dae", ValueError("no mesh"))]
    assert meshes.missing_notes(missing, ["/p"]) == ["a is shown as the physics has it: package://a.dae: No such file",
                                                   "b is shown as the physics has it: b.dae: no mesh"]  # fmt: skip
    assert meshes.missing_notes([], ["/p"]) == []


def test_the_cache_gives_the_same_parts_and_a_broken_one_is_read_anew(tmp_path):
    file = tmp_path / "square.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    first = meshes.load(file, tmp_path / "cache")
    (kept,) = (tmp_path / "cache").iterdir()
    assert len(first[0].faces) == 2
    for content in (kept.read_bytes(), b"", b"PK\x03\x04 no zip", kept.read_bytes()[:-40]):
        kept.write_bytes(content)
        again = meshes.load(file, tmp_path / "cache")
        assert np.array_equal(first[0].vertices, again[0].vertices) and np.array_equal(first[0].faces, again[0].faces)
    assert [path.suffix for path in (tmp_path / "cache").iterdir()] == [".npz"], "nothing partial is left"
    file.write_text("v 0 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n")
    assert meshes.load(file, tmp_path / "cache")[0].vertices.max() == 2.0


def test_points_of_a_cell_become_one_and_flat_triangles_go():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.001, 0, 0], [1, 0.001, 0]], float)
    merged, faces, _ = meshes.merged(vertices, np.array([[0, 1, 2], [3, 4, 2], [0, 3, 2]]), None, 0.01)
    assert len(merged) == 3 and len(faces) == 1


def test_links_without_a_body_are_carried_by_the_one_that_they_are_fixed_to():
    urdf = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><joint name="j" type="fixed"><parent link="a"/>
      <child link="b"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/></joint><joint name="k" type="fixed"><parent link="b"/>
      <child link="c"/><origin xyz="1 0 0"/></joint></robot>"""
    found = urdf_visuals.links_below_bodies(urdf, {"a": None})
    assert {link: body for link, (body, _) in found.items()} == {"a": "a", "b": "a", "c": "a"}
    assert found["c"][1][:3, 3] == pytest.approx([1.0, 1.0, 0.0])
