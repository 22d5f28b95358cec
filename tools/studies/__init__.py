# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: many runs of a case, their table, pictures and ranking; the command is tools/study."""
