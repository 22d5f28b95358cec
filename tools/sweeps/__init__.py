# SPDX-License-Identifier: GPL-3.0-or-later
"""Sets of runs that go on where they stopped, their tables and verdicts: tools/real_cloth.py."""
