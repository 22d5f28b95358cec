# SPDX-License-Identifier: GPL-3.0-or-later
"""Identification: fabrics from measured curves."""
