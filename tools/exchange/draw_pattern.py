# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat patterns as drawings in mm: DXF by ezdxf, and SVG."""

import re
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np

from exchange.flat_pattern import Pattern

MARGIN = 10.0  # mm, of drawings


def yarn_line(pattern: Pattern) -> np.ndarray:
    """Ends (2 x 2, mm) of a line along the yarns, a third of the pattern's size, at its middle."""
    low, high = pattern.outline.min(axis=0), pattern.outline.max(axis=0)
    angle = np.radians(pattern.angle_deg)
    half = np.array((np.cos(angle), np.sin(angle))) * (high - low).min() / 6
    return 0.5 * (low + high) + np.array([-half, half])


def layer_of(family: str) -> str:
    """Of a drawing, where CUT and TEXT have other things on them."""
    name = re.sub(r"[^A-Z0-9_-]", "_", family.upper())
    return f"YARNS_{name}" if name in ("CUT", "TEXT") else name


def write_dxf(pattern: Pattern, path: Path) -> None:
    """Closed polylines on layer CUT, outline and holes; the direction of the first family as a line on
    a layer that is called as it is, WARP of a weave; the name on layer TEXT."""
    import ezdxf
    yarns = layer_of(pattern.yarns)
    drawing = ezdxf.new("R2010")
    drawing.units = ezdxf.units.MM
    for name, colour in (("CUT", 1), (yarns, 5), ("TEXT", 7)):
        drawing.layers.add(name, color=colour)
    space = drawing.modelspace()
    for curve in (pattern.outline, *pattern.holes):
        space.add_lwpolyline(curve, close=True, dxfattribs={"layer": "CUT"})
    ends = yarn_line(pattern)
    space.add_line(*ends, dxfattribs={"layer": yarns})
    size = 0.03 * float(np.ptp(pattern.outline[:, 0]))
    space.add_text(f"{pattern.ply}, {pattern.yarns} at {pattern.angle_deg:g} degrees",
                   dxfattribs={"layer": "TEXT", "height": size,
                               "insert": tuple(ends.mean(axis=0) + (0.0, size))})
    drawing.saveas(path)


def svg_of(pattern: Pattern) -> str:
    """In mm, with y upwards."""
    low = pattern.outline.min(axis=0) - MARGIN
    wide, high = pattern.outline.max(axis=0) + MARGIN - low
    (x1, y1), (x2, y2) = yarn_line(pattern)
    cuts = "\n".join(
        f'<polygon id="{name}" points="{" ".join(f"{x:.4f},{-y:.4f}" for x, y in curve)}" fill="none" '
        'stroke="#d00000" stroke-width="0.25"/>'
        for name, curve in (("cut", pattern.outline),
                            *((f"hole{k}", hole) for k, hole in enumerate(pattern.holes, 1))))
    size = 0.03 * wide
    return f'''<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.4f}mm" height="{high:.4f}mm" \
viewBox="{low[0]:.4f} {-low[1] - high:.4f} {wide:.4f} {high:.4f}">
<title>{escape(pattern.ply)}</title>
{cuts}
<line id="yarns" x1="{x1:.4f}" y1="{-y1:.4f}" x2="{x2:.4f}" y2="{-y2:.4f}" stroke="#0040d0" \
stroke-width="0.5"/>
<text x="{x1:.4f}" y="{-y1 + 1.5 * size:.4f}" font-size="{size:.2f}" font-family="sans-serif">\
{escape(pattern.ply)}, {escape(pattern.yarns)} at {pattern.angle_deg:g} degrees</text>
</svg>
'''
