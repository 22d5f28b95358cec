#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing of the groups of tools/packages.txt, and of further packages:
#   tools/install_packages.sh build|report|studio|exchange|test|test-run... [PACKAGE]...
# Nothing is asked of apt when nothing is missing. Exit code 1, and what to do, when it cannot.
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
wanted=()
for name; do
  case $name in
    build | report | studio | exchange | test | test-run)
      mapfile -t -O "${#wanted[@]}" wanted < <(
        sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$tools/packages.txt" |
          awk -v group="[$name]" '/^\[/ { inside = $0 == group; next } inside'
      ) ;;
    *) wanted+=("$name") ;;
  esac
done

fail() {
  printf 'install_packages.sh: error: %s\n' "$@" >&2
  exit 1
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  fail "this system has no apt-get. plyform is built with packages of Debian 12. Install the same
  programs and libraries (CMake >= 3.25, a C++20 compiler, FCL 0.7, CGAL >= 5.5) in your system's
  own way, then run: cmake --preset release && cmake --build --preset release
  Debian's names for them: ${wanted[*]}"
fi

# dpkg-query answers 1 as soon as one package is unknown to it: that is no error here.
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "$package installed" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "Installing missing packages: ${missing[*]}"
as_root=(env)
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "only root can install packages. Run as root:
  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo env)
fi

# Waits for another apt instead of failing at its lock.
apt_get() {
  "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@"
}
install_missing() {
  apt_get install -y --no-install-recommends "${missing[@]}"
}

# The lists are only fetched when they do not know a package, or know one the archive has replaced.
if ! apt-get install --simulate --no-install-recommends "${missing[@]}" >/dev/null 2>&1; then
  apt_get update || fail "apt-get update failed; see its message above"
  install_missing
else
  install_missing || { apt_get update && install_missing; }
fi || fail "apt-get could not install: ${missing[*]}
  plyform needs the packages of Debian 12 (bookworm) or newer"
