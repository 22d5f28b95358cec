# SPDX-License-Identifier: GPL-3.0-or-later
"""What every part of the workbench stands on: the folder, the guard of requests, events, the application."""
