# SPDX-License-Identifier: GPL-3.0-or-later
"""Mapping against exact fields: a ply on a dome whose directions are known at every point, ribs, and
what goes wrong.

    exchange_map_test.py TOOLS

Leaves with 77 when numpy, scipy or h5py is missing.
"""

import sys
from dataclasses import replace

try:
    import numpy as np
    import scipy  # noqa: F401

    from exchange_meshes import (RADIUS, disc, dome_ply, flat_of, grid, shell_mesh, yarns_at)
    from exchange.closest import Surface
    from exchange.layup import Layup, angle_between, map_all, there_and_back
    from exchange.mapping import sample, sides_of, SmoothPly, map_ply
    from exchange.shell_mesh import centroids, element_normals, triangle_normals, unit
    from exchange.formed import FormedPly
    from exchange.mirror import mirrored
    from plotting.reading import Trouble
except ImportError as error:
    print("SKIPPED:", error)
    sys.exit(77)

MOST_DEG = {2.0: 0.2, 5.0: 0.5, 12.0: 1.5}  # rms, by the size of the elements


def rms(values):
    assert np.isfinite(values).all() and len(values)
    return float(np.sqrt(np.mean(np.square(values))))


def check_dome():
    """Quadrilaterals and triangles of three sizes, yarns at four angles: against the smoothed field
    at the elements' middles, and against the exact one."""
    for angle in (0.0, 30.0, 45.0, 60.0):
        ply = dome_ply(angle)
        smooth = SmoothPly(ply)
        for size, most in MOST_DEG.items():
            for triangles in (False, True):
                mesh = disc(size, triangles)
                (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
                assert mapped.covered().all() and (mapped.side == 1).all()
                middles = centroids(mesh)
                triangle, weights, _ = smooth.surface.closest(middles, 10.0)
                _, warp, weft, thickness = smooth.at(triangle, weights)
                exact = yarns_at(flat_of(middles), angle)
                errors = [rms(angle_between(in_plane(mesh, one), two))
                          for one, two in ((warp, mapped.warp), (weft, mapped.weft),
                                           (exact[0], mapped.warp), (exact[1], mapped.weft))]
                print(f"dome {angle:g} deg, {'triangles' if triangles else 'quads'} of {size:g} mm: "
                      f"{max(errors[:2]):.3f} deg rms to the smoothed field, "
                      f"{max(errors[2:]):.3f} to the exact one, "
                      f"thickness {rms(thickness - mapped.thickness):.5f} mm")
                assert max(errors) < most, errors
                assert rms(thickness - mapped.thickness) < 0.01
                shear = 90.0 - angle_between(mapped.warp, mapped.weft)
                assert np.allclose(mapped.shear_deg, shear, atol=1e-6)


def in_plane(mesh, vectors):
    normals = element_normals(mesh)[0]
    return unit(vectors - (vectors * normals).sum(axis=1, keepdims=True) * normals)


def check_there_and_back():
    """Onto a finer and a coarser mesh and back: smaller with smaller elements."""
    ply = dome_ply(30.0, count=22)  # all of it within the disc
    last = 0.0
    for size in (2.0, 5.0, 12.0):
        mesh = disc(size, False, reach=80.0)
        (mapped,), (smooth,) = map_all([ply], mesh, 5.0, 0.5, False)
        back = there_and_back(smooth, mapped, mesh, 5.0)
        print(f"there and back by {size:g} mm: {back}")
        assert last < back.angle_rms < MOST_DEG[size] and back.thickness_rms < 0.01
        last = back.angle_rms


def check_rib():
    """A ply over a rib 2 mm thick, up one wall, over it and down the other; the part has both
    walls as its surface. Yarns differ from wall to wall, so that one through the rib would show."""
    for gap in (0.0, 0.4, -0.4):  # mm from the part's surface to the ply, outwards
        ply, part = rib(1.0 + gap, 2.0, 30.0), rib(1.0, 3.1, 30.0)
        corners = np.column_stack([part.triangles, np.full(len(part.triangles), -1)])
        mesh = shell_mesh(part.x, corners)
        turned = np.arange(len(corners)) % 3 == 0  # a part mesh that runs every way round
        mesh.corners[turned] = mesh.corners[turned][:, [0, 2, 1, 3]]
        (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
        assert mapped.covered().all(), f"{(~mapped.covered()).sum()} not covered"
        error = angle_between(mapped.warp, part.warp)
        wall = np.abs(element_normals(mesh)[0][:, 0]) > 0.9
        low = wall & (centroids(mesh)[:, 2] < -6.0)
        print(f"rib, gap {gap:g}: {error[low].max():.2f} deg at most on its walls, "
              f"{error[wall].max():.2f} beside its sharp top, where nodes belong to both")
        assert error[low].max() < 0.01 and error[wall].max() < 10.0  # the other wall: 50
        assert ((mapped.side < 0) == turned).all()
        one_wall = ply.x[ply.triangles].mean(axis=1)[:, 0] > 0.5
        (mapped,), _ = map_all([part_of(ply, one_wall)], mesh, 5.0, 0.5, False)
        other = wall & (centroids(mesh)[:, 0] < 0)
        assert not mapped.covered()[other].any(), "mapped through the rib"
        assert mapped.covered()[wall & (centroids(mesh)[:, 0] > 0)].mean() > 0.9


def rib(half, size, height):
    """A sheet along y over a rib of half-thickness `half` mm, as a ply; warp at 20 degrees to y on
    one wall, 70 on the other."""
    top = 2
    count = int(height // size)
    path = np.vstack([np.column_stack([np.full(count, -half), np.linspace(-height, -size, count)]),
                      np.column_stack([np.linspace(-half, half, top + 1), np.zeros(top + 1)]),
                      np.column_stack([np.full(count, half), np.linspace(-size, -height, count)])])
    along = np.arange(0.0, 40.0 + 1e-9, size)
    x = np.array([(a, y, b) for a, b in path for y in along])
    n = len(along)
    first = (np.arange(len(path) - 1)[:, None] * n + np.arange(n - 1)).ravel()
    quads = np.column_stack([first, first + n, first + n + 1, first + 1])
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    normals = triangle_normals(x, triangles)[0]
    middles = x[triangles].mean(axis=1)
    angle = np.radians(np.where(middles[:, 0] < 0, 20.0, 70.0))[:, None]
    y = np.array((0.0, 1.0, 0.0))
    across = np.cross(normals, np.broadcast_to(y, normals.shape))
    warp = np.cos(angle) * y + np.sin(angle) * across
    m = len(triangles)
    return FormedPly("rib", 0.0, x, x, triangles, warp, np.cross(normals, warp), np.zeros(m),
                     np.full(m, 0.6), 0.6, 90.0)


def check_closed_skin():
    """A plate 2 mm thick as a skin in one piece, with a hole in its top, where the ply lies. Its
    underside, larger and almost as near, is not covered, whichever way the skin's normals point."""
    flat, quads = grid(20)
    top = np.column_stack([40.0 * flat, np.ones(len(flat))])
    rim = rim_of(quads)
    count = len(top)
    sides = np.column_stack([rim[:, 1], rim[:, 0], rim[:, 0] + count, rim[:, 1] + count])
    hole = (np.abs(top[quads].mean(axis=1)[:, :2]) < 10.0).all(axis=1)
    skin = np.vstack([quads[~hole], quads[:, ::-1] + count, sides])
    ply = flat_ply(40.0, 1.3)
    for corners in (skin, skin[:, ::-1]):
        mesh = shell_mesh(np.vstack([top, top * (1, 1, -1)]), corners)
        (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
        height = centroids(mesh)[:, 2]
        assert mapped.covered()[height > 0.9].all() and not mapped.covered()[height < 0.9].any()


def rim_of(quads):
    """Border edges of quadrilaterals, in the direction of their corners."""
    ends = np.vstack([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    there = {tuple(edge) for edge in ends.tolist()}
    return np.array([edge for edge in ends.tolist() if (edge[1], edge[0]) not in there])


def flat_ply(half, height):
    """A flat ply of 2 x half mm, yarns along x and y."""
    flat, quads = grid(20)
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    x = np.column_stack([half * flat, np.full(len(flat), height)])
    ones = np.ones((len(triangles), 1))
    return FormedPly("flat", 0.0, x, x, triangles, ones * (1.0, 0, 0), ones * (0, 1.0, 0),
                     np.zeros(len(ones)), np.full(len(ones), 0.6), 0.6, 90.0)


def check_mirror():
    """A quarter and its images are the whole ply, the yarns too; angles that no plane mirrors are
    refused."""
    mesh = disc(6.0, False, reach=60.0)
    for angle in (0.0, 90.0, 45.0, -45.0):
        whole = dome_ply(angle, count=30)
        middles = whole.x0[whole.triangles].mean(axis=1)
        quarter = part_of(whole, (middles[:, :2] > 0).all(axis=1))
        both = mirrored(mirrored(quarter, "x"), "y")
        assert len(both.x) == len(whole.x) and len(both.triangles) == len(whole.triangles)
        flat = both.x0[both.triangles].mean(axis=1)[:, :2]
        for found, wanted in zip((both.warp, both.weft), yarns_at(flat, angle)):
            assert angle_between(found, wanted).max() < 1e-6
        assert np.allclose(both.shear_deg, 90.0 - angle_between(both.warp, both.weft))
        outwards = both.x[both.triangles].mean(axis=1) + (0.0, 0.0, RADIUS)
        assert ((triangle_normals(both.x, both.triangles)[0] * outwards).sum(axis=1) > 0).all()
        (mapped,), _ = map_all([both], mesh, 5.0, 0.5, False)
        exact = yarns_at(flat_of(centroids(mesh)), angle)[0]
        assert mapped.covered().all()
        assert angle_between(in_plane(mesh, exact), mapped.warp).max() < 0.5
    for ply, told in ((whole, "lies on both sides of x = 0"),
                      (part_of(dome_ply(30.0, count=30), (middles[:, :2] > 0).all(axis=1)),
                       "at 30 degrees, are not those of its image")):
        try:
            mirrored(ply, "x")
            raise AssertionError("mirrored")
        except Trouble as problem:
            assert told in str(problem), problem


def part_of(ply, triangles):
    """These triangles of a ply, and their nodes."""
    used, rows = np.unique(ply.triangles[triangles], return_inverse=True)
    return replace(ply, x0=ply.x0[used], x=ply.x[used], triangles=rows.reshape(-1, 3),
                   warp=ply.warp[triangles], weft=ply.weft[triangles],
                   shear_deg=ply.shear_deg[triangles], thickness=ply.thickness[triangles])


def check_closest():
    """Against every triangle asked."""
    ply = dome_ply(0.0, count=12)
    normals = triangle_normals(ply.x, ply.triangles)[0]
    surface = Surface(ply.x, ply.triangles, normals)
    points = np.random.default_rng(1).uniform(-60, 60, (60, 3))
    triangle, weights, distance = surface.closest(points, 1e9)
    for k, point in enumerate(points):
        corners = ply.x[ply.triangles]
        least = min(np.linalg.norm(point - brute(point, *three)) for three in corners)
        assert abs(least - distance[k]) < 1e-9, (least, distance[k])
    near, _, _ = surface.closest(points, 5.0)
    assert ((near >= 0) == (distance <= 5.0)).all()


def brute(p, a, b, c):
    """Closest point of a triangle by the projection onto its plane and its three edges."""
    n = np.cross(b - a, c - a)
    foot = p - (p - a) @ n / (n @ n) * n
    signs = [np.cross(e - s, foot - s) @ n for s, e in ((a, b), (b, c), (c, a))]
    if min(signs) >= 0:
        return foot
    ends = [s + np.clip((p - s) @ (e - s) / ((e - s) @ (e - s)), 0, 1) * (e - s)
            for s, e in ((a, b), (b, c), (c, a))]
    return min(ends, key=lambda q: np.linalg.norm(p - q))


def check_cover():
    """A flat ply of 100 mm on a plate of 200 mm: what is beyond its border is not covered, and
    shares of area add up to that of the ply."""
    ply = flat_ply(50.0, 1.0)
    flat, quads = grid(27)
    mesh = shell_mesh(np.column_stack([100.0 * flat, np.zeros(len(flat))]), quads)
    (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
    inside = np.abs(centroids(mesh)[:, :2]).max(axis=1) < 50.0
    assert (mapped.covered() == inside).all()
    area = (element_normals(mesh)[1] * mapped.share).sum()
    print(f"covered area {area:.1f} of 10000 mm2")
    assert abs(area - 10000.0) < 300.0
    assert np.allclose(mapped.distance[inside], 1.0) and np.isnan(mapped.thickness[~inside]).all()
    mesh.corners = mesh.corners[:, [0, 3, 2, 1]]  # normals down the stack
    smooth = SmoothPly(ply)
    side = sides_of(mesh, [smooth], 5.0, False)
    turned = map_ply(smooth, mesh, side, 5.0)
    assert (turned.side[inside] == -1).all()
    warp, weft = Layup(mesh, [turned], "x", "", False).angles(turned)
    assert np.allclose(warp[inside], 0.0) and np.allclose(weft[inside], -90.0)
    assert abs(sample(mesh, 1.0).areas.sum() - 40000.0) < 1e-6


def on_cone(flat):
    """Points of a disc on a cone of 45 degrees below them, and what x and y become there."""
    distance = np.linalg.norm(flat, axis=1)[:, None]
    slope = flat / distance
    return (np.hstack([flat, -distance]),
            *(np.column_stack([np.full(len(flat), 1.0 - k), np.full(len(flat), float(k)), -slope[:, k]])
              for k in (0, 1)))


def check_seam():
    """A cone meshed round its axis, its nodes double along the seam: the angles there go on as they do
    elsewhere, within the change from an element to the next."""
    flat, quads = grid(61)
    flat = 61.0 * flat
    triangles = np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    x, (_, warp, weft) = on_cone(flat)[0], on_cone(flat[triangles].mean(axis=1))
    ones = np.ones(len(triangles))
    ply = FormedPly("cone", 0.0, np.column_stack([flat, 0 * flat[:, 0]]), x, triangles, unit(warp),
                    unit(weft), 0 * ones, 0.6 * ones, 0.6, 90.0)
    rings, round_it = np.linspace(20.0, 50.0, 11), np.linspace(0.0, 2 * np.pi, 73)
    nodes = on_cone(np.array([(r * np.cos(a), r * np.sin(a)) for a in round_it for r in rings]))[0]
    first = np.array([[a * 11 + r for r in range(10)] for a in range(72)]).ravel()
    mesh = shell_mesh(nodes, np.column_stack([first, first + 1, first + 12, first + 11]))
    (mapped,), _ = map_all([ply], mesh, 5.0, 0.5, False)
    assert mapped.covered().all()
    exact = unit(on_cone(centroids(mesh)[:, :2])[1])
    assert angle_between(mapped.warp, exact).max() < 0.3
    angles = Layup(mesh, [mapped], (1.0, 1.0, 0.0), "", False).angles(mapped)[0].reshape(72, 10)
    change = np.abs((np.roll(angles, -1, axis=0) - angles + 90.0) % 180.0 - 90.0).max(axis=1)
    print(f"cone: angles change by {change[-1]:.2f} degrees over its seam, {change.max():.2f} at most")
    assert change[-1] < 1.05 * np.median(change)


if __name__ == "__main__":
    check_closest()
    check_seam()
    check_cover()
    check_dome()
    check_there_and_back()
    check_rib()
    check_closed_skin()
    check_mirror()
