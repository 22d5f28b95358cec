# SPDX-License-Identifier: GPL-3.0-or-later
"""Results: figures over runs, reports, exports, files."""
