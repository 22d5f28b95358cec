# SPDX-License-Identifier: GPL-3.0-or-later
"""What a report says in words, before any figure: does it form, where does it shear most, does it
wrinkle, how much force; what not to trust. Texts are HTML, numbers in <data> for the browser."""

from dataclasses import dataclass

import numpy as np
from base.summary_file import doubts_and_advice
from markupsafe import Markup

from .reading_run import PlyStates, Run

WRINKLE = 1.0    # mm: lower waves are not called wrinkles; the page says so
PRESSED = 0.02   # of the length: the more pressed yarns count as buckled
BALANCE = 0.01   # of the largest energy


@dataclass
class Place:
    """A triangle that the reader is shown."""
    run: int
    ply: int
    triangle: int
    field: str


@dataclass
class Answer:
    title: str
    number: Markup            # the figure that counts
    text: Markup
    place: Place | None = None
    warns: bool = False       # something that a good part would not have
    words: Markup = Markup("")  # for the sentence at the top, if it warns


def number(value: float | None, digits: int) -> Markup:
    if value is None or not np.isfinite(value):
        return Markup("–")
    return Markup('<data class="number" value="{}" data-digits="{}">{:.{}f}</data>').format(
        f"{value:.9g}", digits, value, digits)


def percent(share: float | None, digits: int) -> Markup:
    return number(None if share is None else 100.0 * share, digits)


def small(value: float) -> Markup:
    """Of an error: two figures that count."""
    return number(value, int(np.clip(1 - np.floor(np.log10(value)), 0, 9)) if value > 0.0 else 0)


def at_place(x) -> Markup:
    return Markup("x&nbsp;{}, y&nbsp;{}, z&nbsp;{}&nbsp;mm").format(*(number(c, 0) for c in x))


def reached(run: Run, state: int, digits: int) -> Markup:
    """How far a state is: its stroke, or the time where nothing has one."""
    if run.has_stroke():
        return Markup("{}&nbsp;mm of stroke").format(number(float(run.stroke_mm[state]), digits))
    return Markup("{}&nbsp;ms").format(number(1e3 * float(run.time_s[state]), digits))


def verdict(run: Run, found: list[Answer]) -> tuple[str, Markup]:
    """A word for the status and a sentence."""
    there = reached(run, -1, 2)
    if run.summary is None:
        return "unfinished", Markup("Not finished: the run goes on, or was killed. What is shown is "
                                    "its last state, at {}.").format(there)
    status = run.summary["status"]
    if status == "stopped":
        return status, Markup("Does not form: plyform stopped the run at {}. {}"
                              ).format(there, sentence(run.summary["message"]))
    if status == "interrupted":
        return status, Markup("Not finished: the run was interrupted at {}."
                              ).format(there)
    if status == "instant":
        return status, Markup("A first answer: {}").format(sentence(run.summary["message"]))
    pressed = any("load_pressure_N_mm2" in ply.history for ply in run.plies)
    what = "Forms" if run.tools or pressed else "Ran to its end (no tools: a test of the fabric)"
    there = Markup("to {}" if run.has_stroke() else "in {}").format(there)
    warnings = [answer.words for answer in found if answer.warns]
    if warnings:
        return status, Markup("{} {}, but {}.").format(
            what, there, Markup("; ").join(warnings))
    return status, Markup("{} {}: nothing found against it.").format(what, there)


def sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("." if text and text[-1] not in ".!?" else "")


def answers_of(run: Run, index: int, more: list[Answer | None] = ()) -> list[Answer]:
    """`more`: cards of rooms of their own."""
    found = [shear(run, index), wrinkles(run, index), bridging(run, index), force(run), *more,
             pressed(run, index), opening(run, index), stitches(run, index), drawn_in(run)]
    return [answer for answer in [*found, accuracy(run)] if answer]


def shear(run: Run, index: int) -> Answer:
    angles = [abs(ply.cells["shear_angle_deg"][-1]) for ply in run.plies]
    k = int(np.argmax([one.max() for one in angles]))
    ply, triangle = run.plies[k], int(angles[k].argmax())
    text = Markup("Most in <b>{}</b> at {}").format(ply.name, at_place(middle(ply, triangle)))
    if (p99 := run.summary_of(ply.name).get("p99_shear_deg")) is not None:
        text += Markup("; 99&nbsp;% of that ply has at most {}°").format(number(p99, 1))
    beyond = [(one.name, summary["area_share_beyond_locking_angle"]) for one in run.plies
              if (summary := run.summary_of(one.name)).get("area_share_beyond_locking_angle") is not None]
    over = [(name, share) for name, share in beyond if share > 0.0]
    answer = Answer("Shear angle", Markup("{}°").format(number(float(angles[k].max()), 1)), text,
                    Place(index, k, triangle, "shear"), bool(over))
    if over:
        name, share = max(over, key=lambda one: one[1])
        answer.words = Markup("{} passes its locking angle on {}&nbsp;% of its area").format(
            name, number(100.0 * share, 1))
        answer.text += Markup(". Beyond the locking angle: {}").format(Markup(", ").join(
            Markup("{} on {}&nbsp;%").format(n, number(100.0 * s, 1)) for n, s in over))
    elif beyond:
        answer.text += Markup(". No ply passes its locking angle")
    else:
        answer.text += Markup(". The fabric states no locking angle to compare with")
    answer.text += "."
    return answer


def middle(ply: PlyStates, triangle: int) -> np.ndarray:
    return ply.x[-1, ply.triangles[triangle]].mean(axis=0)


def nearest(ply: PlyStates, point) -> int:
    middles = ply.x[-1][ply.triangles].mean(axis=1)
    return int(np.linalg.norm(middles - np.asarray(point), axis=1).argmin())


def highest(run: Run, key: str) -> tuple[int, dict] | None:
    plies = [(k, run.summary_of(ply.name)) for k, ply in enumerate(run.plies)]
    plies = [(k, one) for k, one in plies if one.get(key) is not None]
    return max(plies, key=lambda one: one[1][key]) if plies else None


def wrinkles(run: Run, index: int) -> Answer | None:
    if not (most := highest(run, "wrinkle_height_mm")):
        return None
    k, summary = most
    height, name = summary["wrinkle_height_mm"], run.plies[k].name
    value = Markup("{}&nbsp;mm").format(number(height, 1))
    place = summary.get("wrinkle_at_mm", [None])
    if height <= 0.0 or None in place:
        return Answer("Wrinkles", value, Markup("None that the mesh shows."))
    text = Markup("Highest wave in <b>{}</b>, {}&nbsp;mm long, at {}. ").format(
        name, number(summary.get("wrinkle_length_mm"), 0), at_place(place))
    high = [run.plies[i].name for i, ply in enumerate(run.plies)
            if (run.summary_of(ply.name).get("wrinkle_height_mm") or 0.0) >= WRINKLE]
    text += Markup("From {}&nbsp;mm it is called a wrinkle: {}.").format(
        number(WRINKLE, 0), "yes, in " + ", ".join(high) if high else "no ply has one")
    return Answer("Wrinkles" if high else "Wrinkles: none", value, text,
                  Place(index, k, nearest(run.plies[k], place), "wrinkle"),
                  bool(high), Markup("{} wrinkle{}, {} mm high at most").format(
                      ", ".join(high), "" if len(high) > 1 else "s", number(height, 1)))


def bridging(run: Run, index: int) -> Answer | None:
    """Where plies span hollows of tools, of runs in which something presses them there."""
    most = highest(run, "bridging_height_mm")
    if not most or not most[1]["bridging_height_mm"] > 0.0:
        return None
    k, summary = most
    place = summary.get("bridging_at_mm", [None])
    text = Markup("Highest over the tool in <b>{}</b>{}, over {}&nbsp;mm² of that ply in all.").format(
        run.plies[k].name, "" if None in place else Markup(" at {}").format(at_place(place)),
        number(summary.get("bridging_area_mm2"), 0))
    if summary.get("bridging_max_tension_N_per_yarn") is not None:
        text += Markup(" Tension of {} there: {}&nbsp;N per yarn at most, {} in the mean.").format(
            summary.get("bridging_family"), number(summary["bridging_max_tension_N_per_yarn"], 2),
            number(summary.get("bridging_mean_tension_N_per_yarn"), 2))
    others = [Markup("{} {}&nbsp;mm").format(one.name, number(height, 1)) for i, one in enumerate(run.plies)
              if i != k and (height := run.summary_of(one.name).get("bridging_height_mm") or 0.0) > 0.0]
    if others:
        text += Markup(" Others: {}.").format(Markup(", ").join(others))
    return Answer("Bridging", Markup("{}&nbsp;mm").format(number(summary["bridging_height_mm"], 1)),
                  text, None if None in place else Place(index, k, nearest(run.plies[k], place), "bridging"))


def force(run: Run) -> Answer | None:
    bodies = [(tool.name, tool.force_N, np.ptp(tool.stroke_mm)) for tool in run.tools]
    bodies += [(name, numbers["force_N"][1], 1.0) for name, numbers in run.grips.items()]
    bodies = [(name, force_N, way) for name, force_N, way in bodies if np.isfinite(force_N).all()]
    if not bodies:
        return None
    name, force_N, _ = max(bodies, key=lambda body: (body[2], np.nan_to_num(abs(body[1][-1]))))
    if np.isnan(force_N[-1]):
        return force_not_known(run, name, force_N)
    k = int(abs(force_N).argmax())
    text = Markup("On <b>{}</b> at the end; the largest of all states is {}&nbsp;N at {}."
                  ).format(name, number(float(force_N[k]), digits_of(force_N[k])),
                           reached(run, k, 1))
    others = [Markup("{} {}&nbsp;N").format(n, number(float(f[-1]), digits_of(f[-1])))
              for n, f, _ in bodies if n != name and not np.isnan(f[-1])]
    if others:
        text += Markup(" Others: {}.").format(Markup(", ").join(others))
    value = Markup("{}&nbsp;N").format(number(float(force_N[-1]), digits_of(force_N[-1])))
    return Answer("Force", value, text)


def force_not_known(run: Run, name: str, force_N: np.ndarray) -> Answer:
    """Of a tool that presses the plies against another one."""
    k = int(np.flatnonzero(~np.isnan(force_N))[-1])
    text = Markup("<b>{}</b> presses the plies against another tool, with less room than they are "
                  "thick: from there on its force would be that of contact, not of the cloth. The "
                  "last that is known is {}&nbsp;N at {}.").format(
                      name, number(float(force_N[k]), digits_of(force_N[k])),
                      reached(run, k, 1))
    return Answer("Force", Markup("not known"), text)


def digits_of(value: float) -> int:
    return 0 if abs(value) >= 100.0 else 1 if abs(value) >= 10.0 else 2


def pressed(run: Run, index: int) -> Answer | None:
    most = highest(run, "max_pressed_strain")
    if not most or not run.plies[most[0]].families:
        return None
    k, summary = most
    ply, largest = run.plies[k], summary["max_pressed_strain"]
    strain = np.min([values[-1] for values in ply.of_quantity("strain")], axis=0)
    share = max(run.summary_of(one.name).get("area_share_pressed_over_2_percent") or 0.0
                for one in run.plies)
    text = Markup("Most in <b>{}</b>. Over 2&nbsp;%, where yarns buckle, it is on {}&nbsp;% of "
                  "the area of the worst ply.").format(ply.name, number(100.0 * share, 1))
    return Answer("Pressed yarns", Markup("{}&nbsp;%").format(number(100.0 * largest, 1)), text,
                  Place(index, k, int(strain.argmin()), "pressed"), share > 0.01,
                  Markup("yarns of {} are pressed by {}&nbsp;%").format(
                      ply.name, number(100.0 * largest, 1)))


def opening(run: Run, index: int) -> Answer | None:
    """How far yarns have come apart across, of families for which it is told."""
    told = [(k, one) for k, ply in enumerate(run.plies)
            for one in run.summary_of(ply.name).get("openings", [])
            if one.get("largest") is not None and None not in one["at_mm"]]
    if not told:
        return None
    k, most = max(told, key=lambda one: one[1]["largest"])
    ply = run.plies[k]
    text = Markup("Between <b>{}</b> of <b>{}</b>, at {}: how much further apart neighbouring yarns "
                  "lie than before forming.").format(most["family"], ply.name,
                                                     at_place(most["at_mm"]))
    over = [(run.plies[i].name, one) for i, one in told if (one.get("area_share_beyond_limit") or 0) > 0]
    for name, one in over:
        text += Markup(" {} of {} pass their limit of {}&nbsp;% on {}&nbsp;mm², {}&nbsp;% of the area."
                       ).format(one["family"], name, percent(one["limit"], 1),
                                number(one["area_mm2_beyond_limit"], 0),
                                percent(one["area_share_beyond_limit"], 1))
    if not over:
        limits = any(one.get("limit") is not None for _, one in told)
        text += Markup(" No family passes its limit." if limits
                       else " The fabric states no limit to compare with.")
    return Answer("Opening between yarns", Markup("{}&nbsp;%").format(percent(most["largest"], 1)),
                  text, Place(index, k, nearest(ply, most["at_mm"]), f"{most['family']}-opening"),
                  bool(over), Markup("yarns of {} gape by {}&nbsp;%").format(
                      ply.name, percent(most["largest"], 1)))


def stitches(run: Run, index: int) -> Answer | None:
    found = [(k, one) for k, ply in enumerate(run.plies)
             for one in run.summary_of(ply.name).get("stitches") or []]
    if not found:
        return None
    k, most = max(found, key=lambda one: one[1].get("broken_length_share") or 0.0)
    if not (share := most.get("broken_length_share")):
        return Answer("Broken stitches", "none", "No stitch broke.")
    ply, name = run.plies[k], most["name"]
    at, patch = most["largest_broken_patch_at_mm"], most["largest_broken_patch_mm2"]
    text = Markup("Most of {} in <b>{}</b>, on {}&nbsp;mm² of the flat ply; the largest patch, {}"
                  "&nbsp;mm², is about {}.").format(
        name, ply.name, number(most["broken_area_mm2"], 0), number(patch, 0), at_place(at))
    return Answer("Broken stitches", Markup("{}&nbsp;%").format(number(100.0 * share, 1)), text,
                  Place(index, k, nearest(ply, at), f"{name}-broken"), False,
                  Markup("{}&nbsp;% of {} in {} is broken").format(
                      number(100.0 * share, 1), name, ply.name))


def drawn_in(run: Run) -> Answer | None:
    draw_ins = [(ply.name, drawn) for ply in run.plies
                if (drawn := run.summary_of(ply.name).get("draw_in_mm"))
                and drawn.get("largest") is not None]
    if not draw_ins:
        return None
    name, drawn = max(draw_ins, key=lambda one: one[1]["largest"])
    return Answer("Draw-in", Markup("{}&nbsp;mm").format(number(drawn["largest"], 1)),
                  Markup("Most in <b>{}</b>; its mean over eight directions is {}&nbsp;mm."
                         ).format(name, number(drawn.get("mean"), 1)))


def accuracy(run: Run) -> Answer | None:
    if not run.summary or "accuracy" not in run.summary:
        return None
    predicted = run.summary["accuracy"]
    error = predicted.get("promised_shear_error_deg")
    if error is None:
        if "unknown" not in predicted:
            return None
        return Answer("Band of error", Markup("–"),
                      Markup("No error of the shear angles is predicted: {}."
                             ).format(predicted["unknown"]))
    causes = Markup("inertia {}°, softened fibres {}°, mesh {}°").format(
        *(number(predicted.get(f"{cause}_deg"), 2) for cause in ("inertia", "softening", "mesh")))
    balance = run.summary["energy"].get("balance_error")
    text = Markup("Predicted, rms over all plies and not of single places: {}. The energy balance closes to {}&nbsp;%."
                  ).format(causes, number(100.0 * abs(balance or 0.0), 3))
    return Answer("Band of error", Markup("±{}°").format(number(error, 1)), text, None,
                  abs(balance or 0.0) > BALANCE, Markup("the energy balance is off"))


def doubts(run: Run) -> list[str]:
    """What not to trust, a sentence each."""
    if not run.summary:
        return ["There is no summary.json: errors, wrinkles and pressed yarns were not looked at."]
    return [sentence(text) for text in doubts_and_advice(run.summary)[0] or [run.summary["message"]]]
