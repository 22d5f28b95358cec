# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: data of runs, texts, three.js and the modules of web/, all in one file."""

import base64
import json
from pathlib import Path

import jinja2
import numpy as np

from base.ending import one_line
from base.files import read_text
from base.progress import doing, told
from base.results_file import Column
from base.summary_figures import described
from plotting.reading import Trouble

from . import answers, fibre_volume, series
from .encode import Blocks
from .reading_run import PlyStates, Run, ToolStates
from .simplify import simplified

WEB = Path(__file__).resolve().parent / "web"
THREE = Path("/usr/share/javascript/three/three.min.js")
TOOL_TOLERANCE = 0.3     # mm, of simplify: nearer than a tenth of a millimetre
MOST = 4.0  # times the precision of a column: errors larger than that are not allowed
POSITION = (0.002, 0.009)  # mm
LETTERS = "ABCD"  # of runs beside each other: more are too small to be seen


def page_of(runs: list[Run]) -> str:
    """HTML of one run, or of up to four beside each other."""
    blocks, titles = Blocks(), titles_of(runs)
    columns = {column.name: column for run in runs for ply in run.plies for column in ply.columns}
    by_time = not all(run.has_stroke() for run in runs)
    scene = {"runs": [scene_of(run, by_time, blocks) for run in runs],
             "along": {"word": "time", "unit": "ms"} if by_time else {"word": "stroke", "unit": "mm"},
             "columns": [shown_as(column) for column in columns.values()]}
    doing("writes the page")
    for one, title in zip(scene["runs"], titles):
        one["title"] = title
    shelf = jinja2.Environment(loader=jinja2.FileSystemLoader(WEB), autoescape=True,
                               trim_blocks=True, lstrip_blocks=True,
                               undefined=jinja2.StrictUndefined)
    shelf.globals.update(number=answers.number, small=answers.small, sentence=answers.sentence)
    texts = [texts_of(run, k) | {"title": title} for k, (run, title) in enumerate(zip(runs, titles))]
    ids = {chart["id"]: chart for run in scene["runs"] for chart in run["charts"]}
    histograms = {one["id"]: one for run in scene["runs"] for one in run["histograms"]}
    return shelf.get_template("report.html").render(
        runs=texts, letters=LETTERS, yarns=yarns_of(runs), charts=list(ids.values()), histograms=list(histograms.values()), along=scene["along"]["word"], place_error=blocks.errors["place"],
        errors=[(column["label"].lower(), column["factor"] * blocks.errors[column["name"]],
                 column["unit"]) for column in scene["columns"]], blocks=blocks.texts,
        scene=json_in_script(scene), style=(WEB / "report.css").read_text(encoding="utf-8"),
        imports=imports(), three=in_script(three()), tool_tolerance=TOOL_TOLERANCE)


def titles_of(runs: list[Run]) -> list[str]:
    """Those of several runs differ: by the names of their folders, or as much of the paths as it takes."""
    titles = [run.title() for run in runs]
    if len(set(titles)) == len(titles):
        return titles
    parts = [run.folder.resolve().parts for run in runs]
    most = max(map(len, parts))
    for count in range(1, most + 1):
        ends = ["/".join(part[-count:]) for part in parts]
        if len(set(ends)) == len(ends):
            return [f"{title} ({one_line(end)})" for title, end in zip(titles, ends)]
    return [f"{title} ({letter})" for title, letter in zip(titles, LETTERS)]  # a run beside itself


def three() -> str:
    if not THREE.is_file():
        raise Trouble(f"{THREE} is missing: install Debian's package libjs-three")
    return read_text(THREE)


def in_script(library: str) -> jinja2.utils.markupsafe.Markup:
    """Of a library, whose texts may close the script that it stands in."""
    return jinja2.utils.markupsafe.Markup(library.replace("</", "<\\/").replace("<!--", "<\\!--"))


def json_in_script(data) -> jinja2.utils.markupsafe.Markup:
    """JSON that is the same wherever it stands: no character of it means anything to HTML, nor ends
    a line of JavaScript. Numbers are finite."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)  # ASCII
    for c in "<>&":
        text = text.replace(c, f"\\u{ord(c):04x}")
    return jinja2.utils.markupsafe.Markup(text)


def imports():
    """The modules of web/ under the names that they import each other by."""
    named = {f"plyform/{file.name}": "data:text/javascript;base64,"
             + base64.b64encode(file.read_bytes()).decode("ascii")
             for file in sorted(WEB.glob("*.js"))}
    return json_in_script({"imports": named})


def texts_of(run: Run, index: int) -> dict:
    """What the texts and tables of the page say of a run."""
    found = answers.answers_of(run, index, [fibre_volume.card(run, index)])
    status, words = answers.verdict(run, found)
    return {"folder": run.name(), "status": status,
            "verdict": words, "answers": found, "doubts": answers.doubts(run),
            "summary": run.summary, "run": run, "triangles": sum(len(p.triangles) for p in run.plies),
            "plies": [(ply, run.summary_of(ply.name)) for ply in run.plies],
            "figures": [one for one in described(run.summary or {}, "plies").values() if one.compared],
            "tools": [(tool, np.nanmax(abs(tool.force_N), initial=0.0)) for tool in run.tools]}


def scene_of(run: Run, by_time: bool, blocks: Blocks) -> dict:
    return {"reached": rounded(1e3 * run.time_s if by_time else run.stroke_mm), "time": rounded(run.time_s),
            "plies": [ply_of(run, ply, blocks) for ply in told("packs", run.plies)],
            "tools": [scene_of_tool(run, tool, blocks) for tool in told("packs", run.tools)],
            "charts": series.charts_of(run), "histograms": fibre_volume.histograms_of(run)}


def yarns_of(runs: list[Run]) -> str:
    """The colours in which families of yarns are drawn (web/shaders.js)."""
    parts = []
    for k, colour in enumerate(("white", "black", "yellow", "blue")):
        names = dict.fromkeys(list(ply.families)[k] for run in runs for ply in run.plies
                              if len(ply.families) > k)
        if names:
            parts.append(f"{' or '.join(names)} {colour}")
    return ", ".join(parts)


def shown_as(column: Column) -> dict:
    """A column for fields.js."""
    return {"name": column.name, "word": column.word,
            "label": column.label[:1].upper() + column.label[1:],
            "unit": series.UNITS.get(column.unit, column.unit), "factor": column.factor,
            "digits": column.digits, "scale": column.scale, "note": column.note,
            "quantity": column.quantity, "place": column.place}


def rounded(values: np.ndarray) -> list:
    return [float(f"{value:.7g}") for value in np.ravel(values)]


def ply_of(run: Run, ply: PlyStates, blocks: Blocks) -> dict:
    summary = run.summary_of(ply.name)
    return {
        "name": ply.name, "thickness": ply.thickness(),
        "size": float(np.ptp(ply.x0, axis=0).max()),
        "families": [{"name": name, "direction": rounded(along)}
                     for name, along in ply.families.items()],
        "woven": not run.summary or "max_pressed_strain" in summary,
        "locking_angle": summary.get("locking_angle_deg"),
        "x0": blocks.add(ply.x0[None], "place", *POSITION),
        "triangles": blocks.add_integers(ply.triangles),
        "x": blocks.add(ply.x, "place", *POSITION),
        "cells": blocks_of(ply, ply.cells, blocks), "nodes": blocks_of(ply, ply.nodes, blocks),
    }


def blocks_of(ply: PlyStates, values: dict[str, np.ndarray], blocks: Blocks) -> dict:
    return {column.name: blocks.add(values[column.name], column.name, column.precision,
                                    MOST * column.precision)
            for column in ply.columns if column.name in values}


def scene_of_tool(run: Run, tool: ToolStates, blocks: Blocks) -> dict:
    x, triangles = simplified(tool.x0, tool.triangles, TOOL_TOLERANCE)
    stack = np.mean([ply.x0[:, 2].mean() for ply in run.plies])
    low, high = tool.x0[:, 2].min(), tool.x0[:, 2].max()
    return {"name": tool.name, "x0": blocks.add(x[None], "place of a tool", *POSITION),
            "triangles": blocks.add_integers(triangles),
            "driven": bool(np.ptp(tool.shift, axis=0).max() > 0.0
                           and abs(tool.stroke_mm[-1] - run.stroke_mm[-1]) < 1e-6),
            "above": bool(0.5 * (low + high) > stack),
            "shift": [rounded(shift) for shift in tool.shift]}
