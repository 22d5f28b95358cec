# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that come in, and what becomes of them in a case."""
