# SPDX-License-Identifier: GPL-3.0-or-later
"""LS-DYNA: *ELEMENT_SHELL_COMPOSITE, thickness and angle of each ply an element.

Angles are from corner 1 to corner 2, whatever --reference says: the axes of a material with AOPT = 0
and BETA = 0. Columns: element, part and four corners of 8 characters; below, two plies a line, each
material, thickness, angle and an empty field of 10 characters.
"""

from exchange.layup import Layup


def lsdyna_files(layup: Layup) -> dict[str, str]:
    mesh = layup.mesh
    layup.expect_room("an LS-DYNA file")
    head = layup.head(["materials need AOPT = 0 and BETA = 0; elements written here have no BETA, MCID "
                       "or OFFSET of their own"], "side from corner 1 to corner 2")
    lines = ["$ " + line for line in head]
    lines += [f"$ material {k}: ply {ply.name}" for k, ply in enumerate(layup.plies, 1)]
    lines += ["$ these elements take the place of those of the same number in your mesh",
              "*KEYWORD"]
    if layup.own:
        lines.append("*NODE")
        lines += [f"{label:8d}{x:16.8f}{y:16.8f}{z:16.8f}"
                  for label, (x, y, z) in zip(mesh.node_labels, mesh.nodes)]
    angles = [layup.angles(ply, "side")[0] for ply in layup.plies]
    lines.append("*ELEMENT_SHELL_COMPOSITE")
    for plies, rows in layup.sequences().items():
        for row in rows:
            lines.append(element_line(mesh, row))
            for k in range(0, len(plies), 2):
                lines.append("".join(
                    f"{one + 1:10d}{layup.plies[one].thickness[row]:10.7f}"
                    f"{angles[one][row]:10.5f}{'':10}" for one in plies[k:k + 2]).rstrip())
    lines.append("*END")
    return {("" if not layup.own else layup.plies[0].name + "_") + "layup.k":
            "\n".join(lines) + "\n"}


def element_line(mesh, row: int) -> str:
    corners = mesh.corners[row]
    ends = [mesh.node_labels[k] for k in corners if k >= 0]
    if len(ends) == 3:
        ends.append(ends[2])
    return "".join(f"{value:8d}" for value in (mesh.labels[row], mesh.parts[row], *ends))
