# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program itself says of a case, asked of processes beside the workbench."""
