#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the pinned requirements of every environment that ./dev makes, with the hashes of all files of a version. It reads
# the *.in files and the pyproject.toml of both packages. Every environment gets the same version of a package. Python 3.11
# or newer and `uv` have to be there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

python=host_tools/python/pyproject.toml
drive=host_tools/python/drive/pyproject.toml
build=host_tools/python/build.in # what they need to build
compile=(uv pip compile --quiet --upgrade --universal --python-version 3.11 --only-binary :all: --no-header --no-annotate)
all=$(mktemp)
trap 'rm -f "$all"' EXIT
"${compile[@]}" --all-extras "$python" "$drive" "$build" {host_tools/site,host_tools/report,tests/web,tests/style}/requirements.in -o "$all" >/dev/null

# lock FILE ARGUMENTS..
lock()
{
    "${compile[@]}" --generate-hashes --constraint "$all" "${@:2}" -o "$1" >/dev/null
    sed -i '1i # tests/style/lock.sh writes this file.' "$1"
}
for directory in host_tools/site host_tools/report tests/web tests/style; do
    lock "$directory/requirements.txt" "$directory/requirements.in"
done
lock host_tools/python/wheels.txt "$python" "$drive" "$build"
lock host_tools/python/drive.txt --extra test "$drive" "$build"
lock host_tools/python/packages.txt --extra campaign --extra examples --extra test "$python" "$drive" "$build"
