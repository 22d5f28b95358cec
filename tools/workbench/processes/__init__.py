# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that go on when the workbench has ended."""
