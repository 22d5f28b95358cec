# SPDX-License-Identifier: GPL-3.0-or-later
"""What all Python programs stand on: how they end, files of others, names that become paths."""
