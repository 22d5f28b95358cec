# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a workbench: its files, what happens to them, questions to processes about them."""
