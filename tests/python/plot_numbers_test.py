# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers behind the pictures of tools/plot.py, against closed forms and brute force.

    plot_numbers_test.py TOOLS_FOLDER

Leaves with 77 when h5py or matplotlib is missing.
"""

import sys
import tempfile
from pathlib import Path

try:
    import h5py  # noqa: F401, the readers need it
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)

sys.path.insert(0, sys.argv[1])
from plot_folders import disc, draped, grid  # noqa: E402
from plotting import folds, numbers  # noqa: E402
from plotting.draw_history import body_of  # noqa: E402
from plotting.draw_plies import nice_range, turned  # noqa: E402
from plotting.looks import folder_labels  # noqa: E402
from plotting.reading import Ply, Trouble, read_table  # noqa: E402

RANDOM = np.random.default_rng(7)
ROUND_OFF = 1e-9  # of lengths of some 100 mm in 64 bits, with room


def ply_of(x0, x, triangles):
    return Ply("p", 0.0, x0, x, triangles, np.arange(len(triangles), dtype=float))


def close(a, b, tolerance=ROUND_OFF):
    difference = np.max(abs(np.asarray(a, dtype=float) - b))
    assert difference <= tolerance, f"{a} is not {b}: {difference} > {tolerance}"  # fails on NaN


def raises(words, function, *arguments):
    try:
        function(*arguments)
    except Trouble as problem:
        assert words in str(problem), problem
        return
    raise AssertionError(f"no trouble about {words}")


def line_of(distance, side=1.0):
    n = len(distance)
    return folds.Line(np.arange(n) * 360.0 / n, 360.0, distance, 100.0 * side, side)


def brute_prominences(y):
    """By definition, for values that differ: walk either way round to something higher."""
    n, found = len(y), []
    for i in range(n):
        if not (y[i] > y[i - 1] and y[i] > y[(i + 1) % n]):
            continue
        bases = []
        for step in (1, -1):
            lowest, j = y[i], i
            while True:
                j = (j + step) % n
                if j == i or y[j] > y[i]:
                    break
                lowest = min(lowest, y[j])
            bases.append(lowest)
        found.append((i, y[i] - max(bases)))
    return found


def prominence_is_what_the_definition_says():
    for n in (3, 4, 17, 200):
        for _ in range(20):
            y = RANDOM.normal(size=n)
            ours, theirs = folds.prominences(y), brute_prominences(y)
            assert [i for i, _ in ours] == [i for i, _ in theirs]
            close([h for _, h in ours], [h for _, h in theirs], 1e-14)


def prominence_counts_a_flat_or_twofold_top_once():
    assert folds.prominences(np.zeros(9)) == []
    assert folds.prominences(np.array([0.0, 1.0, 1.0, 1.0, 0.0])) == [(1, 1.0)]
    assert folds.prominences(np.array([1.0, 0.0, 0.0, 1.0])) == [(0, 1.0)]  # across the seam
    twofold = np.array([0.0, 5.0, 4.5, 5.0, 0.0, 3.0])  # as symmetric meshes make them
    assert folds.prominences(twofold) == [(1, 5.0), (3, 0.5), (5, 3.0)]


def cosines_are_as_many_folds():
    angle = 2.0 * np.pi * np.arange(720) / 720
    for k in (1, 2, 5, 9, 12):
        for start in (0.0, 0.37, 3.0):
            y = 100.0 + 6.0 * np.cos(k * (angle - start))
            found = folds.find_folds(line_of(y, side=4.0))
            assert len(found.peaks) == k, (k, start, found)
            # a peak may lie half a point off: 6 (1 - cos(k pi / 720)) = 0.008 at most
            close([found.amplitude_mm, found.largest_mm], 6.0, 0.01)


def noise_below_the_depth_is_no_fold():
    angle = 2.0 * np.pi * np.arange(500) / 500
    for _ in range(20):
        noise = RANDOM.uniform(-0.9, 0.9, 500)  # 1.8 from top to bottom
        assert len(folds.find_folds(line_of(100.0 + noise, side=4.0)).peaks) == 0
        assert len(folds.find_folds(line_of(100.0 + noise), 1.81).peaks) == 0
        wavy = 100.0 + 8.0 * np.cos(7 * angle) + noise
        found = folds.find_folds(line_of(wavy, side=4.0))
        assert len(found.peaks) == 7, found
        close(found.amplitude_mm, 8.0, 0.9)
        assert len(folds.find_folds(line_of(noise), 1e-3).peaks) > 50  # and it is there


def the_depth_says_where_it_comes_from():
    small = folds.find_folds(line_of(np.array([0.0, 3.0, 0.0, 3.0]), side=4.0))
    close(small.depth_mm, 2.0)
    assert "4 mm" in small.reason and len(small.peaks) == 2
    large = folds.find_folds(line_of(np.array([0.0, 3.0, 0.0, 60.0]), side=4.0))
    close(large.depth_mm, 6.0)  # the 3 mm are ripples on 60
    assert "60 mm" in large.reason and len(large.peaks) == 1
    given = folds.find_folds(line_of(np.array([0.0, 3.0, 0.0, 60.0]), side=4.0), 2.9)
    assert given.reason == "--depth" and list(given.peaks) == [1, 3]
    close([given.amplitude_mm, given.largest_mm], [0.5 * (3 + 3 + 60 + 60) / 4, 30.0])


def a_flat_square_has_four_corners_but_no_folds_on_a_ring():
    x0, triangles = grid(20, 200.0)
    line = folds.border_line(ply_of(x0, x0, triangles), (0.0, 0.0))
    close([line.length_mm, line.round, len(line.where)], [800.0, 800.0, 80])
    close(line.mean_side_mm, (10.0 + 10.0 + np.sqrt(200.0)) / 3.0)
    found = folds.find_folds(line)
    assert len(found.peaks) == 4
    close(found.amplitude_mm, 0.5 * 100.0 * (np.sqrt(2.0) - 1.0))
    ring = folds.ring_line(ply_of(x0, x0, triangles), (0.0, 0.0), 90.0)
    close(ring.distance, 90.0)
    assert len(folds.find_folds(ring).peaks) == 0
    raises("leaves the unformed ply p", folds.ring_line, ply_of(x0, x0, triangles), (0.0, 0.0),
           101.0)


def a_draped_disc_has_its_folds_on_border_and_ring():
    x0, triangles = disc(150.0, 30, 180)
    ply = ply_of(x0, draped(x0, 90.0, 9, 12.0), triangles)
    border = folds.find_folds(folds.border_line(ply, (0.0, 0.0)))
    assert len(border.peaks) == 9
    close(border.amplitude_mm, 12.0)  # 180 nodes: one on each crest and one in each valley
    ring = folds.find_folds(folds.ring_line(ply, (0.0, 0.0), 120.0))
    assert len(ring.peaks) == 9
    # halfway out; chords of 4 mm on waves of 84 mm lose up to 1 - cos(9 pi / 180) = 1.2 %,
    # and the facets' sag moves all points by 0.02 mm
    close(ring.amplitude_mm, 6.0, 0.012 * 6.0 + 0.02)


def the_outer_border_is_the_loop():
    x0, triangles = grid(6, 60.0)
    centre = x0[triangles].mean(axis=1)
    holed = triangles[abs(centre[:, :2]).max(axis=1) > 10.0]  # without the middle four squares
    loop = numbers.border_loop(x0, RANDOM.permutation(holed))
    assert len(loop) == len(set(loop)) == 24
    close(abs(x0[loop, :2]).max(axis=1), 30.0)
    close(np.linalg.norm(np.roll(x0[loop], -1, axis=0) - x0[loop], axis=1), 10.0)
    x, y = x0[loop, 0], x0[loop, 1]
    close(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y), 3600.0)  # anticlockwise
    bow_tie = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, 1, 0]])
    raises("meets itself", numbers.border_loop, bow_tie, np.array([[0, 1, 2], [0, 4, 3]]))


def a_section_holds_the_triangles_under_it():
    x0, triangles = grid(9, 90.0)
    shear = np.array([[1.0, 0.3, 0.0], [0.1, 0.8, 0.2], [0.0, 0.0, 1.0]])  # formed linearly
    value = RANDOM.normal(size=len(triangles))
    through, degrees = (3.0, -7.0), 28.0
    cut = numbers.section(x0, x0 @ shear, triangles, value, through, degrees)
    direction = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    middle = np.array(through) + cut.ends.mean(axis=1)[:, None] * direction
    found, weights = numbers.locate(middle, x0, triangles)
    assert (found >= 0).all() and len(found) > 15
    close(weights.sum(axis=1), 1.0)
    close(cut.value, value[found])
    close(cut.ends[1:, 0], cut.ends[:-1, 1])
    # the line leaves the square at x = ±45
    close(cut.ends[[0, -1], [0, 1]], [-48.0 / direction[0], 42.0 / direction[0]])
    ends = np.array(through) + cut.ends[..., None] * direction
    close(cut.formed, np.concatenate([ends, 0.0 * ends[..., :1]], axis=2) @ shear)


def a_section_on_edges_takes_the_mean_of_both_sides():
    x0, triangles = grid(4, 40.0)
    centre = x0[triangles].mean(axis=1)
    value = np.where(centre[:, 1] > 0.0, 5.0, 1.0)
    cut = numbers.section(x0, x0, triangles, value, (0.0, 0.0), 0.0)
    close(cut.ends, np.array([[-20, -10], [-10, 0], [0, 10], [10, 20]]))
    close(cut.value, 3.0)
    cut = numbers.section(x0, x0, triangles, value, (0.0, 20.0), 180.0)  # a border
    close(cut.ends, np.array([[-20, -10], [-10, 0], [0, 10], [10, 20]]))
    raises("does not cross", numbers.section, x0, x0, triangles, np.ones(len(triangles)),
           (0.0, 20.1), 0.0)


def a_section_stops_at_holes():
    x0, triangles = grid(6, 60.0)
    holed = triangles[abs(x0[triangles].mean(axis=1)[:, :2]).max(axis=1) > 10.0]
    cut = numbers.section(x0, x0, holed, np.ones(len(holed)), (0.0, 3.0), 0.0)
    close(np.sum(cut.ends[:, 1] - cut.ends[:, 0]), 40.0)
    jump = np.flatnonzero(cut.ends[1:, 0] - cut.ends[:-1, 1] > 1.0)
    assert len(jump) == 1
    close([cut.ends[jump[0], 1], cut.ends[jump[0] + 1, 0]], [-10.0, 10.0])


def polar_angles_are_those_of_a_sphere():
    theta = np.radians([[-80.0, -20.0], [-20.0, 0.0], [0.0, 30.0], [30.0, 95.0]])
    centre = np.array([3.0, -4.0, 5.0])
    for up in (1.0, -1.0):  # draped over the top, or pressed down
        points = centre + 70.0 * np.stack([0.6 * np.sin(theta), 0.8 * np.sin(theta),
                                           up * np.cos(theta)], axis=-1)
        close(numbers.polar_angle(points, 70.0 * theta, centre), np.degrees(theta))


def ratios_are_taken_on_the_curve():
    x, y = np.array([0.0, 1.0, 3.0]), np.array([0.0, 10.0, 30.0])
    got = numbers.interpolate(np.array([0.5, 2.0, 3.0, 3.1]), x, y)
    close(got[:3], [5.0, 20.0, 30.0])
    assert np.isnan(got[3])
    raises("rise", numbers.interpolate, x, np.array([0.0, 1.0, 1.0]), y)
    ratio = numbers.deviation(np.array([1.0, 5.5, 18.0, 1.0]), np.array([0.0, 5.0, 20.0, np.nan]))
    close(ratio[1:3], [10.0, -10.0])
    assert np.isnan(ratio[[0, 3]]).all()


def the_driven_body_is_found():
    stroke = np.linspace(0.0, 20.0, 5)
    history = {"stroke_mm": stroke,
               "holder_force_N": stroke, "holder_displacement_mm": 0.01 * stroke,
               "grip_force_N": stroke, "grip_displacement_mm": stroke}
    assert body_of(history, None, "r") == "grip"  # a holder that gives way is not driven
    assert body_of(history, "holder", "r") == "holder"
    raises("it has holder, grip", body_of, history, "punch", "r")
    still = {name: 0.0 * values for name, values in history.items()}
    raises("moves", body_of, still, None, "r")


def pictures_turn_anticlockwise():
    close(turned(np.array([[1.0, 0.0, 5.0], [0.0, 2.0, 0.0]]), 90.0), [[0, 1, 5], [-2, 0, 0]])
    close(turned(np.array([1.0, 0.0, 0.0]), 30.0), [np.sqrt(0.75), 0.5, 0.0])


def scales_end_at_round_numbers_and_hold_everything():
    close(nice_range(0.0, 1.33), [0.0, 1.4])
    for _ in range(200):
        low, high = sorted(10.0 ** RANDOM.uniform(-3, 3) * RANDOM.normal(size=2))
        start, end = nice_range(low, high)
        assert start <= low + 1e-9 and end >= high - 1e-9
        assert end - start < 1.7 * (high - low)
    start, end = nice_range(0.6, 0.6)  # the same thickness everywhere
    assert start < 0.6 < end and end - start < 0.1


def folders_are_told_apart_by_no_more_than_it_takes():
    assert folder_labels([Path("x/a"), Path("y/b/")]) == ["a", "b"]
    assert folder_labels([Path("x/a"), Path("y/a")]) == ["x/a", "y/a"]
    assert folder_labels([Path("x/a"), Path("x/a")]) == ["a", "a"]
    assert folder_labels([Path("x/a/../b")]) == ["b"]


def outlines_are_borders_and_turns():
    x0, triangles = grid(5, 50.0)
    edges = numbers.outline(x0, triangles)
    assert len(edges) == 20
    close(abs(edges).max(axis=2), 25.0)  # of each end
    folded = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0], [12, 2, 5]])  # second one turned over
    edges = numbers.outline(folded, np.array([[0, 1, 2], [0, 2, 3]]))
    assert len(edges) == 5
    flat = numbers.outline(folded, np.array([[0, 1, 2], [0, 3, 2]]))
    assert len(flat) == 4


def tables_are_read_or_said_to_be_wrong():
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "t.csv"
        raises("is missing", read_table, file)
        file.write_text("# SPDX\na, b\n# 1\n1,2\n3,\n", encoding="utf-8")
        table = read_table(file, ["a"])
        close(table["a"], [1.0, 3.0])
        assert table["b"][0] == 2.0 and np.isnan(table["b"][1])
        raises("no column c: it has a, b", read_table, file, ["c"])
        file.write_text("a,b\n1,x\n", encoding="utf-8")
        raises("table of numbers", read_table, file)
        file.write_text("a,b\n1,2,3\n", encoding="utf-8")
        raises("table of numbers", read_table, file)
        file.write_text("a,b\n", encoding="utf-8")
        raises("no row", read_table, file)


CHECKS = [value for name, value in list(globals().items())
          if callable(value) and getattr(value, "__module__", "") == "__main__"
          and not value.__code__.co_argcount]
assert len(CHECKS) >= 19, len(CHECKS)
for check in CHECKS:
    check()
    print("passed:", check.__name__)
