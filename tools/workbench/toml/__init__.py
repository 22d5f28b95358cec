# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits of a TOML text that keep its comments and its order."""
