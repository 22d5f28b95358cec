# SPDX-License-Identifier: GPL-3.0-or-later
"""What tools/map, tools/pattern and tools/export are made of: formed plies, part meshes, mapping
between them, files for the next program, flat patterns."""
