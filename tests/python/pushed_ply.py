# SPDX-License-Identifier: GPL-3.0-or-later
"""A square ply that a ball pushes into a die by 40 mm, for the tests: how long it takes is up to them."""

CASE = """title = "Pushed"
[fabrics]
glass = "{fabrics}/glass_plain_weave.toml"
[blanks.square]
size = [{size:.1f}, {size:.1f}]
mesh = "alternating"
element_size = {element_size:.1f}
[[ply]]
name = "ply"
fabric = "glass"
blank = "square"
angle = 0.0
[[tool]]
name = "punch"
shape = "sphere"
radius = 75.0
position = [0.0, 0.0, 75.6]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 40.0
[[tool]]
name = "die"
shape = "profile"
points = [[80.0, -120.0], [80.0, 0.0, 10.0], [400.0, 0.0]]
[solver]
fibre_softening = 100.0
duration = {duration}
outputs = {outputs}
"""


def pushed_ply(fabrics, size: float, element_size: float, duration: float, outputs: int) -> str:
    """fabrics: their folder; size, element_size: mm, of the blank; duration: s, simulated."""
    return CASE.format(fabrics=fabrics, size=size, element_size=element_size, duration=duration, outputs=outputs)
