# SPDX-License-Identifier: GPL-3.0-or-later
"""CalculiX: the mesh as S6 and S8R, and a composite section with the local axes of each ply, an element
each.

What ccx 2.20 takes, as found by running it: composite sections of S6 and S8R only; no distributions and
no angles in a section, so that each ply of each element has an *ORIENTATION of its own, whose first axis
is the warp; layers along the normal. Its room for nodes is reckoned by the entries of the sets of
sections, and is too small where neighbours differ in thickness ("increase nk_"): each set has its element
twice. Sets and orientations are found fastest in the order of the alphabet, so numbers have zeros in
front.
"""

import numpy as np

from plotting.reading import Trouble

from exchange.layup import Layup, safe_names
from exchange.midside import SecondOrder, second_order

LARGEST = 2**31 - 1  # number of a node or element


def calculix_files(layup: Layup) -> dict[str, str]:
    mesh, full = layup.mesh, second_order(layup.mesh)
    if max(int(full.node_labels.max()), int(mesh.labels.max())) > LARGEST:
        raise Trouble(f"a CalculiX file has room for {LARGEST} as the largest number of a node or "
                      "element: number the part mesh anew")
    names = safe_names([ply.name for ply in layup.plies])
    rows = np.flatnonzero(np.any([ply.covered() for ply in layup.plies], axis=0))
    bare = np.setdiff1d(np.arange(len(mesh.labels)), rows)
    name = ("" if not layup.own else layup.plies[0].name + "_") + "layup_calculix.inp"
    layup.remarks.append(f"{name}: {middle_words(full)}")
    lines = ["** " + line for line in layup.head(
        ["nodes and shells take the place of those of the same number in your mesh; "
         + middle_words(full),
         "a layer's material is MATERIAL_ and its name; its first axis is the warp",
         "angles do not matter here: each layer of each element has axes of its own",
         *([f"{len(bare)} elements have no ply: give the set PLYFORM_BARE a section"]
           if len(bare) else [])])]
    lines += mesh_lines(layup, full)
    if len(bare):
        lines += ["*ELSET, ELSET=PLYFORM_BARE", *(str(label) for label in mesh.labels[bare])]
    lines += section_lines(layup, names)
    return {name: "\n".join(lines) + "\n"}


def middle_words(full: SecondOrder) -> str:
    if not full.made:
        return "the mesh's own midside nodes"
    first = int(full.node_labels[-full.made])
    return (f"{full.made} midside nodes made, numbers {first} to {first + full.made - 1}, half way "
            "along straight sides: S6 and S8R need them")


def mesh_lines(layup: Layup, full: SecondOrder) -> list[str]:
    mesh = layup.mesh
    used = np.unique(np.concatenate([mesh.corners.ravel(), full.middles.ravel()]))
    used = used[used >= 0]
    lines = ["*NODE"]
    lines += ["%d, %.12g, %.12g, %.12g" % (label, *place) for label, place in
              zip(full.node_labels[used].tolist(), full.nodes[used].tolist())]
    for kind, rows, count in (("S6", np.flatnonzero(mesh.triangular()), 3),
                              ("S8R", np.flatnonzero(~mesh.triangular()), 4)):
        if len(rows):
            ends = np.column_stack([mesh.corners[rows, :count], full.middles[rows, :count]])
            table = np.column_stack([mesh.labels[rows], full.node_labels[ends]])
            lines.append(f"*ELEMENT, TYPE={kind}, ELSET=PLYFORM_SHELLS")
            lines += [", ".join(map(str, row)) for row in table.tolist()]
    return lines


def section_lines(layup: Layup, names: list[str]) -> list[str]:
    axes, lines = [], []
    across = [np.cross(layup.normals, ply.warp) for ply in layup.plies]
    of_row = {int(row): plies for plies, rows in layup.sequences().items() for row in rows}
    for number, row in enumerate(sorted(of_row), 1):
        label, layers = layup.mesh.labels[row], []
        for k in of_row[row]:
            name = f"PLYFORM_A{number:09d}_{k + 1}"
            axes += [f"*ORIENTATION, NAME={name}, SYSTEM=RECTANGULAR",
                     "%.9g, %.9g, %.9g, %.9g, %.9g, %.9g" % (*layup.plies[k].warp[row],
                                                             *across[k][row])]
            layers.append(f"{layup.plies[k].thickness[row]:.9g}, , MATERIAL_{names[k]}, {name}")
        lines += [f"*ELSET, ELSET=PLYFORM_E{number:09d}", f"{label}, {label}",
                  f"*SHELL SECTION, ELSET=PLYFORM_E{number:09d}, COMPOSITE", *layers]
    return axes + lines
