#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a package of Debian in build/release and prints its path: program, Python module, scripts,
# cases and docs (cmake/debian.cmake).
#   tools/package.sh      then, on any Debian 12: apt install ./plyform_*.deb
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tools/install_packages.sh dpkg-dev file
tools/build.sh release plyform _plyform
(cd build/release && cpack)
ls "$PWD"/build/release/plyform_*.deb
