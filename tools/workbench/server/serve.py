# SPDX-License-Identifier: GPL-3.0-or-later
"""The server itself: a socket of the loopback address, a token, uvicorn."""

import secrets
import socket
import webbrowser
from pathlib import Path

import uvicorn

from base.ending import Trouble

from ..project.project import Project
from ..routes import cases, identify, imports, processes, results, runs, studies
from ..studio import Studio
from . import lock
from .app import application
from .guard import Guard

LOOPBACK = "127.0.0.1"


def serve(project: Project, program: Path, port: int, quiet: bool) -> None:
    with bound(port) as listening:
        port, token = listening.getsockname()[1], secrets.token_urlsafe(24)
        studio = Studio(project, program)
        address = f"http://{LOOPBACK}:{port}/{token}/"
        app = Guard(application(studio, routers(studio)), token, port)
        lock.keep_address(project, address)
        studio.processes.watch()
        print(f"plyform studio of {project.root}\n{address}\nCtrl-C ends it; runs go on", flush=True)
        open_browser(address, quiet)
        uvicorn.Server(uvicorn.Config(app, log_level="error", access_log=False, lifespan="on",
                                      ws_max_size=1 << 16, timeout_keep_alive=75,
                                      server_header=False, proxy_headers=False)).run(sockets=[listening])


def routers(studio: Studio) -> list:
    return [subject.routes(studio) for subject in (processes, cases, imports, runs, results, studies, identify)]


def bound(port: int) -> socket.socket:
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((LOOPBACK, port))
        listening.listen(128)  # a browser may be faster than the server's start
    except OSError as problem:
        listening.close()
        raise Trouble(f"--port {port}: {problem.strerror}; give another, or none") from problem
    return listening


def open_browser(address: str, quiet: bool) -> None:
    if not quiet:
        webbrowser.open(address)
