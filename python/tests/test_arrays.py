"""Arrays show the library's memory, without a copy, as long as anyone looks at it."""

import gc
import pickle

import numpy as np
import pytest

import openflank


def address(array):
    return array.__array_interface__["data"][0]


def test_poses_are_rows_of_tip_and_unit_vector(fitted):
    poses = fitted.path.strips[0].poses
    assert poses.shape == (len(fitted.path.strips[0]), 6) and poses.dtype == np.float64
    assert np.allclose(np.linalg.norm(poses[:, 3:], axis=1), 1.0, atol=1e-9)
    assert sum(len(strip) for strip in fitted.path.strips) == fitted.path.pose_count


@pytest.mark.parametrize("look", [
    lambda part, result: result.path.strips[0].poses,
    lambda part, result: result.motions[0].tip_poles,
    lambda part, result: result.tool.coefficients,
    lambda part, result: part["F1"].poles,
    lambda part, result: part["F1"].knots_u,
    lambda part, result: result.report.histogram_area_mm2])
def test_views_are_no_copies_and_cannot_be_written(blade, fitted, look):
    part = openflank.read_part(blade)
    first, second = look(part, fitted), look(part, fitted)
    assert first.size > 0 and address(first) == address(second)
    assert not first.flags.writeable and not first.flags.owndata
    with pytest.raises(ValueError):
        first.flat[0] = 1.0


def test_a_view_keeps_its_owner_alive(blade):
    poles = openflank.read_part(blade)["F1"].poles
    copy = poles.copy()
    points = openflank.read_part(blade).target("F1").samples(5.0).points
    copied = points.copy()
    gc.collect()
    _ = [np.random.default_rng(k).random(1000) for k in range(100)]
    assert np.array_equal(poles, copy) and np.array_equal(points, copied)


def test_points_of_a_face_are_on_its_target(blade):
    part = openflank.read_part(blade)
    face, target = part["F1"], part.target("F1")
    uv = np.column_stack([np.linspace(0.1, 0.9, 9), np.linspace(0.2, 0.8, 9)])
    scale = [face.knots_u[-1], face.knots_v[-1]]
    points, normals = face.points(uv * scale), face.normals(uv * scale)
    found = target.closest(points + 0.5 * normals)
    assert np.allclose(found.points, points, atol=1e-7)
    assert np.allclose(found.distances_mm, 0.5, atol=1e-9)
    assert np.allclose(found.normals, normals, atol=1e-7)
    assert face.area_mm2 == pytest.approx(target.samples(1.0).areas_mm2.sum(), rel=1e-3)
    assert np.all(target.box[0] <= found.points.min(axis=0) + 1e-6)


def test_wrong_shapes_are_refused(blade):
    target = openflank.read_part(blade).target("F1")
    with pytest.raises(openflank.UsageError, match="points: expected an array N x 3"):
        target.closest(np.zeros((3, 2)))
    with pytest.raises(openflank.UsageError, match="poses: expected an array N x 6"):
        openflank.Path([np.zeros((3, 5))])
    with pytest.raises(openflank.UsageError, match="strip 1, pose 0: .* unit vector"):
        openflank.Path([np.zeros((3, 6))])
    with pytest.raises(openflank.UsageError, match="at least one"):
        openflank.Path([])
    assert target.closest(np.zeros((0, 3))).points.shape == (0, 3)


def test_swept_distances_of_a_cylinder():
    tool = openflank.Tool("cylinder", 20, radius=3)
    path = openflank.Path([[[0, 0, 0, 0, 0, 1], [10, 0, 0, 0, 0, 1]]])
    found = openflank.swept_distances(tool, path, [[5, 4, 10], [5, 1, 10], [-4, 0, 5], [2.5, 7, 20]])
    assert np.allclose(found.f_mm, [1, -2, 1, 4], atol=1e-9)
    assert found.strip.tolist() == [0, 0, 0, 0]
    assert np.allclose(found.t, [0.5, 0.5, 0, 0.25], atol=1e-6) and found.s[3] == 20


def test_a_path_is_copied_in_and_written(fitted, tmp_path):
    path = openflank.Path([strip.poses for strip in fitted.path.strips], face="F1")
    assert path.to_json() == fitted.path.to_json()
    path.save(tmp_path / "path.json")
    assert openflank.Path.load(tmp_path / "path.json").to_json() == path.to_json()
    assert openflank.Path.from_json(path.to_json()).pose_count == path.pose_count


def test_tools_of_families(tmp_path):
    cone = openflank.Tool("cone", 30, radius=2, angle_deg=3)
    assert cone.parameters == pytest.approx({"radius": 2, "angle_deg": 3})
    s = np.linspace(0, 30, 7)
    assert np.allclose(cone.radius(s), 2 + s * np.sin(np.radians(3)))
    assert np.allclose(cone.slope(s), np.sin(np.radians(3)))
    assert cone.smallest_radius_mm == 2.0 and cone.largest_radius_mm == pytest.approx(2 + 30 * np.sin(np.radians(3)))
    profile = cone.meridian(11)
    assert profile.shape == (11, 2)
    assert np.allclose(np.diff(profile[:, 1]) / np.diff(profile[:, 0]), np.tan(np.radians(3)))
    held = openflank.Tool("cylinder", 20, radius=4, shank=[(20, 4), (60, 4)], holder=[(60, 15), (100, 15)])
    assert held.shank.tolist() == [[20, 4], [60, 4]] and held.holder.shape == (2, 2)
    for tool in (cone, held, openflank.Tool.spline(25, [3, 3.5, 4, 4.2, 4])):
        tool.save(tmp_path / "tool.json")
        assert openflank.Tool.load(tmp_path / "tool.json") == tool == pickle.loads(pickle.dumps(tool))
        assert openflank.Tool.from_json(tool.to_json()) == tool
    assert cone != held


def test_wrong_tools_are_refused():
    with pytest.raises(openflank.UsageError, match="sphere: expected cylinder, cone"):
        openflank.Tool("sphere", 30, radius=2)
    with pytest.raises(openflank.UsageError, match="angle_deg: must be given; a cone has radius, angle_deg"):
        openflank.Tool("cone", 30, radius=2)
    with pytest.raises(openflank.UsageError, match="angle: is no parameter"):
        openflank.Tool("cone", 30, radius=2, angle=3, angle_deg=3)
    with pytest.raises(openflank.InputError):
        openflank.Tool("cylinder", 30, radius=-2)
    with pytest.raises(openflank.UsageError, match="axis_length_mm"):
        openflank.Tool("cylinder", -30, radius=2)


def test_a_mesh_has_its_triangles(flank, tmp_path):
    flank("example", "envelope-mesh", "-o", tmp_path / "blade.stl")
    part = openflank.read_part(tmp_path / "blade.stl", unit="mm")
    assert part.is_mesh and part.vertices.shape[1] == 3 and part.triangles.shape[1] == 3
    assert part.triangles.dtype == np.int32 and part.triangles.max() < len(part.vertices)
    corners = part.vertices[part.triangles]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
    assert area == pytest.approx(sum(face.area_mm2 for face in part.faces), rel=1e-2)
    with pytest.raises(openflank.InputError, match="mm, cm, m, in|unit"):
        openflank.read_part(tmp_path / "blade.stl")
    with pytest.raises(openflank.UsageError, match="is of a mesh"):
        part["F1"].poles


def test_what_a_notebook_shows(blade, fitted):
    svg = fitted.tool._repr_svg_()
    assert svg.startswith("<svg ") and svg.endswith("</svg>") and "polygon" in svg
    assert "F1" in openflank.read_part(blade)._repr_html_()
    assert "pass" in fitted.report._repr_html_()
    assert "<svg" in fitted._repr_html_()


def test_the_judge_agrees_with_the_pipeline(blade, fitted):
    report = openflank.judge(fitted.tool, fitted.path, openflank.read_part(blade), "F1", tolerance_mm=0.1)
    assert report.verdict == "pass"
    assert report.coverage == pytest.approx(fitted.report.coverage, abs=2e-3)
    assert report.overcut_mm == pytest.approx(fitted.report.overcut_mm, abs=5e-3)
    assert report.overcut_mm <= report.overcut_bound_mm <= 0.1
    assert len(report.histogram_edges_mm) == len(report.histogram_area_mm2) + 1
    assert report.histogram_area_mm2.sum() == pytest.approx(report.faces[0].area_mm2, rel=1e-6)
