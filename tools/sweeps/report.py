# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers, tables and verdicts of a set of runs."""

import csv
import io
from math import isfinite, nan
from pathlib import Path

from area_means import compare
from compare import table
from plotting.reading import Trouble, read_summary
from sweeps.runs import ENDED, Folder
from sweeps.sets import Entry, Must, Set

NONE = "–"
RADIUS_MM = 10.0  # of the discs, 20 mm wide
HIDDEN = ("run", "target_mm", "waits", "is_reference")  # in CSV
SOME = 8          # names of missing runs that are told
MANY = 5          # plies; of more a cell shows the range


def number(value) -> float:
    """NaN for what is missing or null."""
    return float(value) if isinstance(value, (int, float)) else nan


def largest(values) -> float:
    """NaN if one of them is; of none 0."""
    values = list(values)
    return nan if any(map(lambda v: v != v, values)) else max(values, default=0.0)


def deepest(summary: dict, between_plies: bool) -> float:
    """Since the start, of the pairs of plies (a ply with itself too) or of plies with tools."""
    plies = {ply["name"] for ply in summary["plies"]}
    if "pairs" not in summary:
        return nan
    return largest(number(pair.get("deepest_mm")) for pair in summary["pairs"]
                   if ({pair["a"], pair["b"]} <= plies) == between_plies)


def pressed(ply: dict) -> float:
    if "max_pressed_strain" in ply:
        return number(ply["max_pressed_strain"])
    return max(0.0, -number(ply.get("min_fibre_strain")))


def row_of(entry: Entry, folder: Folder) -> dict:
    """The numbers of a run that has ended."""
    place = folder.of(entry.run)
    told = read_summary(place)
    energy, contact, plies = told["energy"], told["contact"], told["plies"]
    forces = {tool["name"]: number(tool.get("force_N")) for tool in told["tools"]}
    cpu = folder.settings(entry.run).get("cpu_s", told.get("wall_time_s"))
    return {
        "run": entry.run, "x": entry.x, "label": label(entry), "status": told["status"],
        "message": told.get("message") or "", "target_mm": entry.run.stroke_mm,
        "stroke_mm": number(told.get("stroke_mm")), "triangles": number(told.get("elements")),
        "steps": number(told.get("steps")), "time_s": number(cpu),
        "max_shear_deg": [number(ply.get("max_shear_deg")) for ply in plies],
        "rms_shear_deg": [number(ply.get("rms_shear_deg")) for ply in plies],
        "punch_N": forces.get("punch", nan),
        "crossing_between": number(contact.get("intersections_between_plies")),
        "crossing_within": number(contact.get("intersections_within_plies")),
        "balance_error": number(energy.get("balance_error")),
        "tool_depth_mm": number(contact.get("max_tool_penetration_mm")),
        "tool_deepest_mm": deepest(told, False),
        "ply_depth_mm": number(contact.get("max_ply_penetration_mm")),
        "ply_deepest_mm": deepest(told, True),
        "pressed": largest(map(pressed, plies)),
        "pressed_2": largest(number(ply.get("area_share_pressed_over_2_percent"))
                             for ply in plies),
        "pressed_5": largest(number(ply.get("area_share_pressed_over_5_percent"))
                             for ply in plies),
        "ply_pressed": [pressed(ply) for ply in plies],
        "angles_deg": [number(ply.get("angle_deg")) for ply in plies],
        "apart_deg": [], "jump_deg": [], "outlier_deg": []}


def label(entry: Entry) -> str:
    return entry.run.label + (f", against itself turned by {90 * entry.quarters}°"
                              if entry.quarters else "")


def there(place: Path) -> bool:
    return (place / "summary.json").is_file() and (place / "results.h5").is_file()


def add_differences(row: dict, entry: Entry, folder: Folder, rough: bool) -> None:
    """Area means against the other run. A run is no news against itself; of one that was stopped,
    or whose field cannot be read, the differences are NaN."""
    place = folder.path / "runs" / entry.against
    compared = entry.against and (entry.against != entry.run.name or entry.quarters)
    row["is_reference"] = entry.against == entry.run.name and not entry.quarters
    row["waits"] = bool(compared and not there(place))
    stopped = compared and not row["waits"] and "stopped" in (
        row["status"], read_summary(place)["status"])
    if not rough and (not compared or row["waits"] or stopped):
        row["apart_deg"] = [nan] * len(row["angles_deg"]) if stopped else []
        return
    try:
        told = compare(folder.of(entry.run), place if compared and not row["waits"]
                       else folder.of(entry.run), RADIUS_MM, entry.quarters)
    except Trouble as problem:
        row["message"] = f"{row['message']} {problem}".strip()
        told = [{"rms_deg": nan, "a": {"jump_deg": nan, "outlier_deg": nan}}
                for _ in row["angles_deg"]]
    if compared and not row["waits"]:
        row["apart_deg"] = [nan if stopped else ply["rms_deg"] for ply in told]
    row["jump_deg"] = [ply["a"]["jump_deg"] for ply in told]
    row["outlier_deg"] = [ply["a"]["outlier_deg"] for ply in told]


def rows_of(which: Set, folder: Folder) -> tuple[list[dict], list[Entry]]:
    """Rows of the runs that have ended, and what is missing."""
    rows, missing = [], []
    for entry in which.entries:
        if folder.status(entry.run) not in ENDED:
            missing.append(entry)
            continue
        try:
            rows.append(row_of(entry, folder))
            add_differences(rows[-1], entry, folder, which.rough)
        except KeyError as problem:
            raise Trouble(f"{folder.of(entry.run)}: summary.json has no {problem}") from problem
    return rows, missing


def show(value: float, form: str, factor: float = 1.0) -> str:
    if not isfinite(value):
        return NONE
    text = format(factor * value, form)
    return text.removeprefix("-") if float(text) == 0.0 else text


def by_ply(values: list[float], form: str) -> str:
    if len(values) > MANY:
        return f"{show(min(values), form)} to {show(max(values), form)}"
    return " ".join(show(value, form) for value in values) or NONE


def cells(row: dict, rough: bool) -> list[str]:
    return [row["label"], row["status"], show(row["steps"], ".0f"), show(row["time_s"], ".0f"),
            by_ply(row["max_shear_deg"], ".0f"), by_ply(row["rms_shear_deg"], ".1f"),
            show(row["punch_N"], ".0f"),
            f"{show(row['crossing_between'], '.0f')}, {show(row['crossing_within'], '.0f')}",
            show(row["balance_error"], ".2f", 100.0),
            f"{show(row['tool_depth_mm'], '.3f')} / {show(row['tool_deepest_mm'], '.3f')}",
            f"{show(row['ply_depth_mm'], '.3f')} / {show(row['ply_deepest_mm'], '.3f')}",
            show(row["pressed"], ".1f", 100.0),
            f"{show(row['pressed_2'], '.1f', 100.0)}, {show(row['pressed_5'], '.1f', 100.0)}",
            by_ply(row["apart_deg"], ".1f"),
            *([by_ply(row["jump_deg"], ".2f"), by_ply(row["outlier_deg"], ".1f")]
              if rough else [])]


def markdown(which: Set, rows: list[dict]) -> str:
    head = ["run", "status", "steps", "CPU, s", "largest shear by ply, °", "rms by ply, °",
            "punch, N", "crossing pairs: between plies, within", "balance, %",
            "into tools: end / deepest, mm", "between plies: end / deepest, mm",
            "most pressed, %", "area pressed over 2 %, 5 %", "area means: rms by ply, °",
            *(["jump by ply, °", "outlier by ply, °"] if which.rough else [])]
    return table(head, [cells(row, which.rough) for row in rows], 2)


def csv_text(rows: list[dict]) -> str:
    """A column a number, lists as NAME_1, NAME_2 from the lowest ply."""
    flat = []
    for row in rows:
        one = {"name": row["run"].name}
        for key, value in row.items():
            if isinstance(value, list):
                one.update({f"{key}_{i + 1}": v for i, v in enumerate(value)})
            elif key not in HIDDEN:
                one[key] = value
        flat.append(one)
    columns = list(dict.fromkeys(key for one in flat for key in one))
    out = io.StringIO()
    writer = csv.DictWriter(out, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: f"{value:.6g}" if isinstance(value, float) else value
                      for key, value in one.items()} for one in flat)
    return out.getvalue()


def verdict(must: Must, rows: list[dict], missing: list[Entry]) -> str:
    """One line. What is not a number fails: it is not known to hold."""
    values = [(must.number(row, rows), row) for row in rows if must.where(row)]
    judged = [(value, row) for value, row in values if value is not None]
    lacking = len(values) - len(judged) + sum(must.where({"run": entry.run, "x": entry.x})
                                              for entry in missing)
    bad = [(value, row) for value, row in judged if not value <= must.limit]
    if bad:
        value, row = next((pair for pair in bad if pair[0] != pair[0]),
                          max(bad, key=lambda pair: pair[0]))
        return (f"**fails**: {must.text}: {len(bad)} of {len(judged)}, {value:.3g} in "
                f"{row['label']}")
    worst = f" ({max(value for value, _ in judged):.3g} at most, {len(judged)} judged)" \
        if judged else ""
    return f"**{f'open, {lacking} missing' if lacking else 'holds'}**: {must.text}{worst}"


def verdicts(which: Set, rows: list[dict], missing: list[Entry]) -> str:
    return "\n".join(f"- {verdict(must, rows, missing)}" for must in which.musts)


def remarks(rows: list[dict], missing: list[Entry]) -> list[str]:
    lines = [f"- {row['label']} was stopped at {row['stroke_mm']:.1f} mm: {row['message']}"
             for row in rows if row["status"] == "stopped"]
    if missing:
        names = [entry.run.name for entry in missing]
        lines.append(f"- {len(names)} not there: {', '.join(names[:SOME])}"
                     f"{' and so on' if len(names) > SOME else ''}")
    return lines


def text_of(which: Set, rows: list[dict], missing: list[Entry]) -> str:
    """Table, verdicts and remarks in Markdown."""
    if not rows:
        return "None of these runs is there."
    parts = [markdown(which, rows), verdicts(which, rows, missing),
             "\n".join(remarks(rows, missing))]
    if which.against:
        parts.insert(0, f"Area means against: {which.against}.")
    return "\n\n".join(part for part in parts if part)


def write_csv(rows: list[dict], path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(csv_text(rows), encoding="utf-8")
