"""Selection of points that cover a set: beside all distances to all points."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl.search.spreading import by_blocks, by_points, farthest_first


def by_all_distances(points: np.ndarray, start: np.ndarray, size: int) -> list[int]:
    """Return the same by the definition: each time the first of the points that are farthest from all chosen."""
    squares = ((points[:, None] - points) ** 2).sum(axis=2)
    chosen: list[int] = []
    while len(chosen) < size:
        nearest = squares[:, chosen].min(axis=1, initial=np.inf)
        nearest[chosen] = -1.0
        chosen.append(int(start[len(chosen)] if len(chosen) < len(start) else nearest.argmax()))
    return chosen


@settings(max_examples=20, deadline=None)
@given(
    n=st.integers(1, 300), m=st.integers(1, 4), seed=st.integers(0, 99), decimals=st.sampled_from([0, 1, 16]),
    share=st.floats(0, 1), starts=st.integers(1, 3),
)  # fmt: skip
def test_farthest_points_are_those_by_all_distances(n, m, seed, decimals, share, starts):
    """In one block and in three; with ties and copies, of which there are many where numbers have one digit."""
    rng = np.random.default_rng(seed)
    points = rng.random((n, m)).round(decimals)
    start = rng.permutation(n)[:starts]
    size = max(len(start), round(share * n))
    expected = by_all_distances(points, start, size)
    for way in (by_points, by_blocks):
        assert way(points, start, size).tolist() == expected


def test_many_blocks_and_points():
    points, start = np.random.default_rng(2).random((1500, 2)), np.array([7])
    expected = by_all_distances(points, start, 400)
    for way in (by_points, by_blocks, farthest_first):
        assert way(points, start, 400).tolist() == expected


@pytest.mark.parametrize(("side", "copies", "size"), [(30, 1, 300), (3, 20, 180)])
def test_ties_and_copies_in_many_blocks(side, copies, size):
    """Points of a lattice, of which many are equally far, and copies until none is left."""
    places = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
    points = np.random.default_rng(1).permutation(places.repeat(copies, axis=0)).astype(float)
    expected = by_all_distances(points, np.array([3]), size)
    for way in (by_points, by_blocks):
        assert way(points, np.array([3]), size).tolist() == expected


@pytest.mark.parametrize("way", [by_points, by_blocks])
@pytest.mark.parametrize("scale", [1e-150, 1e150])
def test_scale_does_not_matter(scale, way):
    """Squares of 1e-300 and 1e300 are still normal numbers."""
    points = np.random.default_rng(3).random((300, 2))
    chosen = way(points, np.array([5]), 50).tolist()
    assert way(scale * points, np.array([5]), 50).tolist() == chosen
