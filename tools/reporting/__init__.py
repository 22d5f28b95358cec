# SPDX-License-Identifier: GPL-3.0-or-later
"""What tools/report is made of: readers, figures and fields of a run, and the page."""
