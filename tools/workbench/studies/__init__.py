# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies: their files, plans and tables."""
