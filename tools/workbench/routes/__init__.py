# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages may ask, a file for each subject."""
