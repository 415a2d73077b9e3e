"""Identities that hold for every tool and motion: a rigid motion changes nothing, a scale scales, a reversal reverses."""

import numpy as np
from hypothesis import given, settings, strategies as st

import openflank

numbers = st.floats(-1.0, 1.0, allow_subnormal=False)
SOME = settings(max_examples=25, deadline=None, derandomize=True)


@st.composite
def motions(draw):
    """Tip rails near a line of 40 mm, the axis turning by up to about 40 degrees on the way."""
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    along = np.linspace(0.0, 40.0, 6)
    tip = np.column_stack([along, np.zeros(6), np.zeros(6)]) + random.uniform(-3, 3, (6, 3))
    direction = np.array([0.0, 0.0, 1.0]) + random.uniform(-0.3, 0.3, (6, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    return tip, direction, random


@st.composite
def tools(draw, length=20.0):
    family = draw(st.sampled_from(["cylinder", "cone", "barrel"]))
    radius = draw(st.floats(1.0, 6.0))
    if family == "cylinder":
        return openflank.Tool(family, length, radius=radius)
    if family == "cone":
        return openflank.Tool(family, length, radius=radius, angle_deg=draw(st.floats(-1.0, 15.0)))
    return openflank.Tool(family, length, radius=radius + 3, arc=draw(st.floats(100.0, 300.0)), s0=draw(st.floats(0.0, length)))


@st.composite
def rigid(draw):
    """A rotation and a translation."""
    q = np.array([draw(numbers) for _ in range(4)]) + [1.5, 0, 0, 0]
    w, x, y, z = q / np.linalg.norm(q)
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return rotation, 100.0 * np.array([draw(numbers) for _ in range(3)])


def moved(poses, rotation, shift):
    return np.hstack([poses[:, :3] @ rotation.T + shift, poses[:, 3:] @ rotation.T])


def sampled(motion, length=20.0):
    tip, direction, random = motion
    poses = openflank.RuledMotion(tip, direction, length).sample(1e-3)
    return poses, random.uniform([-5, -15, -5], [45, 15, 25], (50, 3))


@SOME
@given(motions(), tools(), rigid())
def test_a_rigid_motion_leaves_the_swept_distance(motion, tool, placed):
    poses, points = sampled(motion)
    here = openflank.swept_distances(tool, openflank.Path([poses]), points).f_mm
    there = openflank.swept_distances(tool, openflank.Path([moved(poses, *placed)]), points @ placed[0].T + placed[1]).f_mm
    assert np.allclose(here, there, atol=1e-8)


@SOME
@given(motions(), st.floats(1.0, 6.0), st.floats(0.1, 20.0))
def test_the_swept_distance_scales(motion, radius, scale):
    poses, points = sampled(motion)
    small = openflank.swept_distances(openflank.Tool("cylinder", 20, radius=radius), openflank.Path([poses]), points)
    tool = openflank.Tool("cylinder", 20 * scale, radius=radius * scale)
    path = openflank.Path([np.hstack([scale * poses[:, :3], poses[:, 3:]])])
    large = openflank.swept_distances(tool, path, scale * points)
    assert np.allclose(scale * small.f_mm, large.f_mm, atol=1e-8 * max(1.0, scale))


@SOME
@given(motions(), tools())
def test_the_order_of_poses_does_not_matter(motion, tool):
    poses, points = sampled(motion)
    forth = openflank.swept_distances(tool, openflank.Path([poses]), points)
    back = openflank.swept_distances(tool, openflank.Path([poses[::-1]]), points)
    assert np.allclose(forth.f_mm, back.f_mm, atol=1e-9)


@SOME
@given(motions(), tools())
def test_reversed_rails_leave_the_envelope(motion, tool):
    tip, direction, _ = motion
    forth = openflank.RuledMotion(tip, direction, 20.0).envelope(tool, side=1, count_t=9, count_s=7)
    back = openflank.RuledMotion(tip[::-1], direction[::-1], 20.0).envelope(tool, side=-1, count_t=9, count_s=7)
    real = np.abs(forth.c) < 0.99
    assert np.allclose(forth.c, -back.c[::-1], atol=1e-9)
    assert np.allclose(forth.points[real], back.points[::-1][real], atol=1e-7)


@SOME
@given(motions(), tools())
def test_nothing_is_left_inside_a_contact_circle(motion, tool):
    """The judge sees no material above the planner's contact points, and no cut that is deeper than other poses make."""
    tip, direction, _ = motion
    rails = openflank.RuledMotion(tip, direction, 20.0)
    envelope = rails.envelope(tool, side=1, count_t=7, count_s=5)
    real = np.abs(envelope.c) < 0.99
    path = openflank.Path([rails.sample(1e-4)])
    assert np.all(openflank.swept_distances(tool, path, envelope.points[real]).f_mm < 2e-4)


@SOME
@given(motions())
def test_poses_are_rigid(motion):
    tip, direction, _ = motion
    poses = openflank.RuledMotion(tip, direction, 20.0).poses(np.linspace(0, 1, 50))
    assert np.allclose(np.linalg.norm(poses[:, 3:], axis=1), 1.0, atol=1e-14)
    assert np.allclose(poses[0, :3], tip[0]) and np.allclose(poses[-1, :3], tip[-1])
