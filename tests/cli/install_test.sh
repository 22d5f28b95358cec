#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a finished build into a fresh prefix, runs the program and the Python module from there,
# and builds and runs another project (tests/consumer) that knows nothing but that prefix.
#   tests/cli/install_test.sh TESTS_FOLDER BUILD_FOLDER
set -euo pipefail
tests=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

cmake --install "$build" --prefix "$prefix"
# Moved once more: an installed tree may not know where it was installed first.
mv "$prefix" "$work/moved"
prefix=$work/moved
if grep -rnF "$(dirname "$tests")" "$prefix/lib" --include='*.cmake'; then
  echo "install_test.sh: the package names the source folder" >&2
  exit 1
fi
"$prefix/bin/plyform" version
if /usr/bin/python3 -c 'import h5py' 2>/dev/null; then
  "$prefix/bin/plyform" chart "$prefix/share/plyform/cases/studies/real_cloth/one_ply_0.toml" --check \
    -o "$work/study"
fi
if /usr/bin/python3 -c 'import h5py, jinja2' 2>/dev/null &&
  [ -f /usr/share/javascript/three/three.min.js ]; then
  "$prefix/bin/plyform" run "$prefix/share/plyform/cases/picture_frame" -o "$work/frame" --report \
    --set blanks.square.element_size=50 --set solver.outputs=1
  [ -s "$work/frame/report.html" ]
  version=$("$prefix/bin/plyform" --version)
  grep -qF "\"version\": \"${version#plyform }\"" "$work/frame/summary.json"
fi
if /usr/bin/python3 -c 'import h5py, scipy' 2>/dev/null && [ -d "$work/frame" ]; then
  "$prefix/bin/plyform" map "$work/frame" --format csv
  "$prefix/bin/plyform" export "$work/frame" --format gltf
  [ -s "$work/frame/export/state.glb" ]
fi
if /usr/bin/python3 -c 'import fastapi, uvicorn, websockets, tomlkit' 2>/dev/null; then
  "$prefix/bin/plyform" studio --help | grep -q 'studio \[-h\]'
  [ -s "$prefix/share/plyform/tools/workbench/web/workbench.html" ]
fi
package=$prefix/lib/python3/dist-packages
if [ -d "$package" ]; then # the module, if it was built
  PYTHONPATH=$package /usr/bin/python3 -c \
    'import plyform, sys; assert plyform.Case(sys.argv[1]).check().sound; print(plyform.__file__)' \
    "$prefix/share/plyform/cases/hemisphere_0"
fi

# Debian's package: what is in it runs, and other projects' headers are not.
if command -v dpkg-shlibdeps >/dev/null && command -v file >/dev/null; then
  (cd "$build" && cpack -B "$work/package")
  version=$("$prefix/bin/plyform" --version)
  dpkg-deb -x "$work/package/plyform_${version#plyform }_$(dpkg --print-architecture).deb" "$work/unpacked"
  "$work/unpacked/usr/bin/plyform" version
  [ -f "$work/unpacked/usr/share/doc/plyform/docs/users/install.md" ]
  [ ! -e "$work/unpacked/usr/include" ]
fi

cmake -S "$tests/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$work/build"
"$work/build/contact_consumer"
"$work/build/consumer" "$work/results"
