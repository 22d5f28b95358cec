# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: started, watched, ended, gone on with, removed."""
