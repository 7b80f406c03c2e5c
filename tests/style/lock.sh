#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the pinned requirements of every environment that ./dev makes, with the hashes of all files of a version, from the
# *.in files and host_tools/python/pyproject.toml. Every environment gets the same version of a package. Python 3.11 or
# newer; `uv` has to be there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

python=host_tools/python/pyproject.toml
build=host_tools/python/build.in # what pyproject.toml needs to build
compile=(uv pip compile --quiet --upgrade --universal --python-version 3.11 --only-binary :all: --no-header --no-annotate)
all=$(mktemp)
trap 'rm -f "$all"' EXIT
"${compile[@]}" --all-extras "$python" "$build" {host_tools/site,host_tools/report,tests/web,tests/style}/requirements.in -o "$all" >/dev/null

# lock FILE ARGUMENTS..
lock()
{
    "${compile[@]}" --generate-hashes --constraint "$all" "${@:2}" -o "$1" >/dev/null
    sed -i '1i # tests/style/lock.sh writes this file.' "$1"
}
for directory in host_tools/site host_tools/report tests/web tests/style; do
    lock "$directory/requirements.txt" "$directory/requirements.in"
done
lock host_tools/python/drive.txt --extra ui --extra test "$python" "$build"
lock host_tools/python/packages.txt --extra campaign --extra examples --extra test "$python" "$build"
