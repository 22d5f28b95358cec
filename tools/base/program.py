# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the program plyform and the Python module of the same build are."""

import shutil
import sys
from pathlib import Path

from base.ending import TOOLS, Trouble


def find_program(given: Path | None) -> Path:
    """The one given, of the source tree, of the installation (share/plyform/tools), of the PATH.
    Raises Trouble."""
    places = [TOOLS.parent / "build/release/tools/plyform", TOOLS.parents[2] / "bin/plyform",
              Path("plyform")]
    if given:
        places = [given.resolve() if given.is_file() else given]
    for place in places:
        if found := shutil.which(place):
            return Path(found).resolve()
    raise Trouble(f"{places[0]} is no program; build it (tools/build.sh) or give --program")


def add_module_path(program: Path) -> None:
    """Lets `import plyform` find the module that was built with this program: in a build's folder
    python, or below the prefix of an installation."""
    for place in (program.parents[1] / "python", program.parents[1] / "lib/python3/dist-packages"):
        if (place / "plyform/__init__.py").is_file():
            sys.path.insert(0, str(place))
            return
