# SPDX-License-Identifier: GPL-3.0-or-later
"""The error that a study is about, and the runs that are best for their time."""

from base.summary_file import SOUND
from studies.ranking import is_number
from studies.study_file import Study

FRONT = "wall_time_s"


def main_error(study: Study) -> str:
    """Column of the error that pictures show; empty without a reference."""
    fields = study.reference.fields if study.reference else []
    return study.fields[fields[0]].error_columns()["rms"] if fields else ""


def mark_front(rows: list[dict], error: str, time: str = FRONT) -> None:
    """1 where no other run is as fast and as near to the reference, and better in one of both."""
    points = [row for row in rows if row["status"] in SOUND and is_number(row.get(error))]
    for row in rows:
        row["on_front"] = int(any(row is one for one in points) and not any(
            one[time] <= row[time] and one[error] <= row[error] and
            (one[time] < row[time] or one[error] < row[error]) for one in points))
