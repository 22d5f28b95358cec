# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases and fabrics in the folder: read, written, taken back, made new."""
