# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a run that runs are compared by, from its summary.json, and how cases differ."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """`band`: half of it, where a run has been verified; else none."""
    id: str
    label: str
    unit: str
    value: float
    band: float | None = None
    of_ply: bool = False  # of a single one


# of plies: key of the summary, label, unit, factor, by the name of the figure that has a band
OF_PLIES = (("max_shear_deg", "largest shear", "°", 1.0, ""),
            ("p99_shear_deg", "shear that 99 % have less than", "°", 1.0, ""),
            ("rms_shear_deg", "shear, rms", "°", 1.0, "shear of "),
            ("area_share_beyond_locking_angle", "area beyond locking", "%", 100.0, ""),
            ("wrinkle_height_mm", "highest wrinkle", "mm", 1.0, ""),
            ("bridging_height_mm", "bridging height", "mm", 1.0, ""),
            ("bridging_area_mm2", "bridging area", "mm²", 1.0, ""),
            ("fibre_volume_max", "largest fibre volume", "%", 100.0, ""),
            ("max_gap_left_mm", "largest gap left", "mm", 1.0, ""),
            ("mean_temperature_C", "mean temperature", "°C", 1.0, ""),
            ("excess_length_mm", "excess length", "mm", 1.0, ""),
            ("max_pressed_strain", "largest compression", "%", 100.0, "largest compression of "),
            ("max_tension_N_per_yarn", "largest tension", "N per yarn", 1.0, ""))
OF_RUN = ((("energy", "balance_error"), "error of the energy balance", "%", 100.0),
          (("kinetic_over_deformation",), "kinetic energy over deformation", "%", 100.0),
          (("accuracy", "promised_shear_error_deg"), "predicted error of shear", "°", 1.0),
          (("contact", "max_ply_penetration_mm"), "penetration between plies", "mm", 1.0),
          (("stroke_mm",), "stroke", "mm", 1.0), (("wall_time_s",), "time", "s", 1.0),
          (("steps",), "steps", "", 1.0), (("elements",), "triangles", "", 1.0))
KEY_FIGURES = ("largest shear", "highest wrinkle", "draw-in", "time")  # of a list of runs; and a force


def known(value: object) -> bool:
    return isinstance(value, (int, float)) and math.isfinite(value)


def scaled(factor: float, value: float) -> float:
    """With the nine digits that a summary has."""
    return float(f"{factor * value:.9g}")


def figures_of(summary: dict) -> list[Figure]:
    """First those of the whole run: the worst of its plies, forces, errors; then of each ply."""
    bands = {one["name"]: one.get("band") for one in summary.get("verification", {}).get("figures", [])
             if "name" in one}
    of_plies = [(ply["name"], ply_figures(ply, bands)) for ply in summary.get("plies", [])]
    labels = dict.fromkeys(one.label for _, figures in of_plies for one in figures)
    worst = [max((one for _, figures in of_plies for one in figures if one.label == label),
                 key=lambda one: one.value) for label in labels]
    forces = [Figure(f"force of {body['name']}", f"force of {body['name']}", "N", body["force_N"],
                     bands.get(f"force of {body['name']}"))
              for body in (*summary.get("tools", []), *summary.get("boundaries", []))
              if known(body.get("force_N"))]
    of_run = [Figure(label, label, unit, scaled(factor, value)) for path, label, unit, factor in OF_RUN
              if known(value := under(summary, path))]
    single = [Figure(f"{one.label} of {name}", f"{one.label} of {name}", one.unit, one.value, one.band, True)
              for name, figures in of_plies for one in figures]
    return [*worst, *forces, *of_run, *(single if len(of_plies) > 1 else [])]


def ply_figures(ply: dict, bands: dict) -> list[Figure]:
    found = [Figure(label, label, unit, scaled(factor, ply[key]), bands.get(named + ply["name"]) if named else None)
             for key, label, unit, factor, named in OF_PLIES if known(ply.get(key))]
    drawn = (ply.get("draw_in_mm") or {}).get("mean")
    if known(drawn):
        found.append(Figure("draw-in", "draw-in", "mm", drawn, bands.get(f"draw-in of {ply['name']}")))
    return found


def under(summary: dict, path: tuple[str, ...]) -> object:
    for key in path:
        summary = summary.get(key) if isinstance(summary, dict) else None
    return summary


def driven_force(summary: dict) -> Figure | None:
    """Of the tool that goes furthest: the punch, mostly."""
    tools = [tool for tool in summary.get("tools", []) if known(tool.get("displacement_mm"))
             and known(tool.get("force_N"))]
    if not tools:
        return None
    tool = max(tools, key=lambda one: abs(one["displacement_mm"]))
    return Figure("", f"force of {tool['name']}", "N", tool["force_N"])


def differences(cases: list[dict]) -> list[dict]:
    """Keys that the cases do not all give alike: {key, values: one a case, None where it is not
    given}, in the order of the cases."""
    keys = dict.fromkeys(key for case in cases for key in case)
    rows = [{"key": key, "values": [case.get(key) for case in cases]} for key in keys]
    return [row for row in rows if len(set(row["values"])) > 1]
