# SPDX-License-Identifier: GPL-3.0-or-later
"""The workbench: the server of plyform studio, and its page in web/."""
