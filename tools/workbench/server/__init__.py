# SPDX-License-Identifier: GPL-3.0-or-later
"""The server: a socket, the guard of requests, the application."""
